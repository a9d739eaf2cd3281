#include "view/parameter_editor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace redmap::cli {

namespace {

constexpr float kOctavePart = 1.0f / 8, kRangePart = 1.0f / 20;
/// Ranges that span more than this are walked by factors.
constexpr float kWide = 100;

float stepped(const ParameterInfo& info, float value, int step) {
  const float sign = static_cast<float>(step);
  if (info.type == "int") return std::clamp(value + sign, info.minimum, info.maximum);
  const bool by_factors = info.minimum > 0 && info.maximum / info.minimum > kWide;
  const float next =
      by_factors ? value * std::exp2(kOctavePart * sign) : value + kRangePart * (info.maximum - info.minimum) * sign;
  return std::clamp(next, info.minimum, info.maximum);
}

std::string value_text(const std::vector<float>& value) {
  return value.size() == 1 ? fmt::format("{:.6g}", value[0]) : fmt::format("[{:.6g}]", fmt::join(value, ", "));
}

}  // namespace

ParameterEditor::ParameterEditor(const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (is_further_tile(scene, i)) continue;
    const ShaderInfo& shader = object.shader->info();
    for (std::size_t p = 0; p < shader.parameters.size(); ++p)
      entries_.push_back({i, object.declared_name.empty() ? object.name : object.declared_name, shader.parameters[p],
                          object.shader->parameters()[p]});
  }
}

void ParameterEditor::select(int step) {
  if (empty()) return;
  selected_ = (selected_ + entries_.size() + static_cast<std::size_t>(step)) % entries_.size();
}

void ParameterEditor::change(int step) {
  if (empty()) return;
  std::vector<float> value = entries_[selected_].value;
  for (float& component : value) component = stepped(entries_[selected_].info, component, step);
  set(selected_, std::move(value));
}

void ParameterEditor::set(std::size_t entry, std::vector<float> value) {
  Entry& to = entries_[entry];
  for (float& component : value) component = std::clamp(component, to.info.minimum, to.info.maximum);
  to.value = std::move(value), to.changed = true, to.is_baked = false;
}

std::vector<std::size_t> ParameterEditor::unbaked_objects() const {
  std::vector<std::size_t> objects;
  for (const Entry& entry : entries_)
    if (!entry.is_baked && (objects.empty() || objects.back() != entry.object)) objects.push_back(entry.object);
  return objects;
}

void ParameterEditor::settle() {
  for (Entry& entry : entries_) entry.is_baked = true;
}

std::string ParameterEditor::text() const {
  if (empty()) return "";
  const Entry& entry = entries_[selected_];
  return fmt::format("{}.{} = {}", entry.object_name, entry.info.name, value_text(entry.value));
}

std::vector<std::string> ParameterEditor::overrides() const {
  std::vector<std::string> all;
  for (const Entry& entry : entries_)
    if (entry.changed)
      all.push_back(fmt::format("{}.{}={}", entry.object_name, entry.info.name, value_text(entry.value)));
  return all;
}

}  // namespace redmap::cli
