#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// Most frames that a list may have, and how far their numbers may be from 0.
constexpr std::size_t kMostFrames = 1000000;
constexpr double kLargestFrame = 1e9;

/// The frames that a text lists, in its order, each once: "7", "1-100", "1-100x2" (each second one), "1,5,9-12", "10-1"
/// (counts down); "1:100" and "1..100" are "1-100". Numbers may be negative and have up to six digits behind the point.
/// Throws InputError, which begins with the part of the text that is wrong. It does so, too, before more than
/// kMostFrames are made.
std::vector<double> parse_frame_list(std::string_view text);

/// Frames as a text that parse_frame_list() reads, with runs of consecutive numbers as ranges: "1-4,7".
std::string text_of_frames(const std::vector<double>& frames);

/// A frame's number in the fewest digits: "12", "-3", "1.25".
std::string text_of_frame(double frame);

/// Frames per second as they are written: "24", "29.97", "24000/1001". Throws InputError.
double parse_frame_rate(std::string_view text);

}  // namespace burin
