#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shading/sheet/style_sheet.h"
#include "web/view_drawer.h"
#include "web/view_message.h"
#include "web/viewed_scene.h"

// Answers to a page, as they are sent (docs/decisions/0029-live-view.md). `number`: of the message.

namespace burin {

// Texts: JSON.
std::string hello_answer(const ViewedScene& scene, const Look& look, const StyleSheet* sheet);
std::string look_answer(std::int64_t number, const StyleSheet* sheet);
std::string view_answer(std::int64_t number, const View& view);
std::string explain_answer(std::int64_t number, const ExplainedPixel& pixel);
/// `command`: none if only a scene file can say it.
std::string command_answer(std::int64_t number, const std::optional<std::string>& command, const std::string& name);
/// `what`: a message with a place, "sheet:3:12: ...", or without.
std::string error_answer(std::int64_t number, const std::string& what);

// A text in front of bytes.
std::string frame_answer(const ViewMessage& message, const DrawnView& drawn);
std::string file_answer(const ViewMessage& message, const std::string& name, const std::vector<std::string>& notes,
                        const std::string& file);

}  // namespace burin
