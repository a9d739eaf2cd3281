#include "view/panel.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl2.h>
#include <fmt/format.h>
#include <imgui.h>

namespace redmap::cli {

namespace {

/// Ranges that span more than this get a logarithmic slider.
constexpr float kWide = 100;

bool is_colour(const ParameterInfo& info) {
  return info.default_value.size() == 3 && info.minimum == 0 && info.maximum == 1;
}

/// Whether `value` was changed.
bool edit(const ParameterInfo& info, const char* label, std::vector<float>& value) {
  if (is_colour(info)) return ImGui::ColorEdit3(label, value.data(), ImGuiColorEditFlags_Float);
  const bool whole = info.type == "int", wide = info.minimum > 0 && info.maximum / info.minimum > kWide;
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
  return ImGui::SliderScalarN(label, ImGuiDataType_Float, value.data(), static_cast<int>(value.size()), &info.minimum,
                              &info.maximum, whole ? "%.0f" : "%.3g", flags);
}

void lay_out_parameters(ParameterEditor& editor) {
  std::string object;
  for (std::size_t i = 0; i < editor.entries().size(); ++i) {
    const ParameterEditor::Entry& entry = editor.entries()[i];
    if (object != entry.object_name) ImGui::TextUnformatted((object = entry.object_name).c_str());
    std::vector<float> value = entry.value;
    const std::string label = fmt::format("{}##{}", entry.info.name, i);
    if (edit(entry.info, label.c_str(), value)) editor.set(i, std::move(value));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", entry.info.meaning.c_str());
  }
}

}  // namespace

Panel::Panel(const Window& window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL2_Init();
}

Panel::~Panel() {
  ImGui_ImplOpenGL2_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

bool Panel::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Panel::wants_keys() const { return ImGui::GetIO().WantTextInput; }

void Panel::lay_out(ViewState& state, ParameterEditor& editor) {
  ImGui_ImplOpenGL2_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  if (state.shows_panel) {
    ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
    ImGui::Begin("redmap (p hides this)", &state.shows_panel, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::Text("%.1f ms a frame, %.1f ms with the window", 1e3 * state.render_seconds, 1e3 * state.frame_seconds);
    if (state.error >= 0) ImGui::Text("RMSE against 64 samples: %.4f", state.error);
    int shown = static_cast<int>(state.show);
    for (int i = 0; i < static_cast<int>(std::size(kShowNames)); ++i) {
      if (i % 3 != 0) ImGui::SameLine();
      if (ImGui::RadioButton(fmt::format("{} {}", i + 1, kShowNames[i]).c_str(), &shown, i))
        state.show = static_cast<Show>(shown);
    }
    ImGui::Checkbox("one sample a pixel (f)", &state.fast);
    ImGui::Checkbox("one basis reflectance a light (b)", &state.draws_one_basis);
    state.wants_error |= ImGui::Button("error against 64 samples (r)");
    ImGui::Separator();
    lay_out_parameters(editor);
    if (state.is_baking) ImGui::TextUnformatted("baking ...");
    if (!state.message.empty()) ImGui::TextWrapped("%s", state.message.c_str());
    ImGui::End();
  }
  ImGui::Render();
}

void Panel::draw() const { ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData()); }

}  // namespace redmap::cli
