#pragma once

#include <glm/glm.hpp>
#include <string>

#include "shading/line_style.h"

// What a command line is written with.

namespace burin {

/// A word as a shell takes it: in quotes where it needs them.
std::string in_shell(const std::string& word);

/// The shortest text that reads as the same number.
std::string shortest_text(double number);

/// "none", "solid", "dashed".
const char* word_of(HiddenStyle style);

/// "burin render …".
class CommandText {
  public:
    void add(const std::string& word);
    void add(const char* option, const std::string& value);
    void add(const char* option, double value);
    void add(const char* option, const glm::dvec3& value);
    const std::string& text() const { return text_; }

  private:
    std::string text_ = "burin render";
};

}  // namespace burin
