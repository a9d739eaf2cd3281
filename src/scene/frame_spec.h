// Which frames are meant, and what their files are called.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace redmap {

/// Largest frame number, and most frames: over an hour at 24 a second. More is a slip of the finger, and every frame of
/// a scene is checked when it is loaded.
inline constexpr int kMaxFrames = 100'000;

/// Frames of a specification such as "1-300,310,320-400:2" (a range with a step), sorted, each once. Throws Error on
/// anything else, on ranges that run backwards and on more than kMaxFrames frames.
std::vector<int> parse_frames(std::string_view spec);

/// Whether the file name of `pattern` holds a run of '#', the place of the frame's number.
bool has_frame_number(std::string_view pattern);

/// "out.####.png", 7 -> "out.0007.png": as many digits as there are '#', more if the number needs them. Patterns
/// without '#' stay as they are. Throws Error if there is more than one run of '#'.
std::string frame_path(std::string_view pattern, int frame);

}  // namespace redmap
