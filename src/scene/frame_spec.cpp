#include "scene/frame_spec.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"

namespace redmap {

namespace {

int parse_frame(std::string_view text, std::string_view spec) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || value < 0 || value > kMaxFrames)
    throw Error("frames \"{}\": expected whole numbers from 0 to {} as in 1-300,310,320-400:2, found \"{}\"", spec,
                kMaxFrames, text);
  return value;
}

/// "7", "1-300" or "320-400:2".
void append_item(std::string_view item, std::string_view spec, std::vector<int>& frames) {
  const auto dash = item.find('-');
  if (dash == std::string_view::npos) {
    frames.push_back(parse_frame(item, spec));
    return;
  }
  const auto colon = item.find(':', dash);
  const int first = parse_frame(item.substr(0, dash), spec);
  const auto last_length = colon == std::string_view::npos ? std::string_view::npos : colon - dash - 1;
  const int last = parse_frame(item.substr(dash + 1, last_length), spec);
  const int step = colon == std::string_view::npos ? 1 : parse_frame(item.substr(colon + 1), spec);
  if (last < first) throw Error("frames \"{}\": expected a range that runs forwards, found \"{}\"", spec, item);
  if (step == 0) throw Error("frames \"{}\": expected a step of at least 1, found \"{}\"", spec, item);
  for (int frame = first; frame <= last; frame += step) frames.push_back(frame);
}

}  // namespace

std::vector<int> parse_frames(std::string_view spec) {
  std::vector<int> frames;
  for (std::string_view rest = spec;;) {
    const auto comma = rest.find(',');
    append_item(rest.substr(0, comma), spec, frames);
    if (frames.size() > kMaxFrames) throw Error("frames \"{}\": expected at most {} frames", spec, kMaxFrames);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

bool has_frame_number(std::string_view pattern) {
  return pattern.substr(pattern.rfind('/') + 1).find('#') != std::string_view::npos;
}

std::string frame_path(std::string_view pattern, int frame) {
  if (!has_frame_number(pattern)) return std::string(pattern);
  const auto begin = pattern.find('#', pattern.rfind('/') + 1);
  const auto end = std::min(pattern.find_first_not_of('#', begin), pattern.size());
  if (pattern.find('#', end) != std::string_view::npos)
    throw Error("output \"{}\": expected one run of # for the frame's number, found more", pattern);
  return fmt::format("{}{:0{}}{}", pattern.substr(0, begin), frame, end - begin, pattern.substr(end));
}

}  // namespace redmap
