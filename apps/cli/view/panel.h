// What stands over the picture: what is shown, how long it took and how good it is, and a slider for each parameter.
// Drawn by Dear ImGui.
#pragma once

#include <string>

#include "view/parameter_editor.h"
#include "view/window.h"

namespace redmap::cli {

/// In the order of their keys, from 1 on.
enum class Show { kOriginal, kMap, kSupersampled, kParameters, kPaper, kSplit };
inline constexpr const char* kShowNames[] = {"original",   "map",   "supersampled",
                                             "parameters", "paper", "map | original"};

/// What the keys and the panel change, and what the panel says.
struct ViewState {
  Show show = Show::kMap;
  bool fast = false, draws_one_basis = false, shows_panel = true;
  bool wants_error = false;  ///< against a reference, once
  bool is_baking = false;
  double render_seconds = 0, frame_seconds = 0;
  double error = -1;    ///< RMSE; negative: not measured
  std::string message;  ///< what went wrong
};

class Panel {
 public:
  explicit Panel(const Window& window);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// Whether the pointer or the keyboard are the panel's.
  bool wants_mouse() const;
  bool wants_keys() const;
  /// Asks what was changed since the last frame.
  void lay_out(ViewState& state, ParameterEditor& editor);
  /// Draws what was laid out last into the window's context.
  void draw() const;
};

}  // namespace redmap::cli
