#include "map/map_description.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "map/certificate_json.h"
#include "map/json_reader.h"
#include "map/map_file.h"
#include "map/tangent_moments.h"

namespace redmap {
namespace {

constexpr MapVerdict kVerdicts[] = {MapVerdict::kReduces, MapVerdict::kOneMaterial, MapVerdict::kDoesNotReduce};

Json list(Vec3 v) { return {v.x, v.y, v.z}; }

std::vector<BasisPlace> parse_basis(const JsonReader& reader, const std::string& where) {
  const Json& list = reader.get("basis", "a list of places");
  if (!list.is_array() || list.empty() || list.size() > kMaxBasis)
    reader.refuse("basis", fmt::format("a list of 1 to {} places", kMaxBasis));
  std::vector<BasisPlace> basis;
  for (const Json& entry : list) {
    const JsonReader place(entry, fmt::format("{}: basis {}", where, basis.size()));
    const std::vector<float> uv = place.numbers("uv", 2, 2);
    basis.push_back(
        {place.vector("position"), place.unit_vector("normal"), place.unit_vector("tangent"), {uv[0], uv[1]}});
    if (!entry.contains("frame_z")) continue;
    basis.back().frame_z = place.unit_vector("frame_z"), basis.back().frame_x = place.unit_vector("frame_x");
  }
  return basis;
}

/// A model as one list of numbers, angle by angle, and its error at the end.
constexpr std::size_t kLobeFloats = LobeModel::kAngles * LobeModel::kAngleFloats + 1;
Json lobe_list(const LobeModel& model) {
  const float* first = &model.angles[0].constant[0];
  std::vector<float> numbers(first, first + kLobeFloats - 1);
  numbers.push_back(model.error);
  return numbers;
}

std::vector<LobeModel> parse_lobes(const JsonReader& reader, std::size_t basis, const std::string& where) {
  const Json& list = reader.get("lobes", "a list of lobe models");
  if (!list.is_array() || list.size() != basis) reader.refuse("lobes", fmt::format("{} lobe models", basis));
  std::vector<LobeModel> lobes(basis);
  for (std::size_t b = 0; b < basis; ++b) {
    const Json wrapped{{"model", list[b]}};
    const JsonReader model(wrapped, fmt::format("{}: lobes {}", where, b));
    const std::vector<float> numbers = model.numbers("model", kLobeFloats, kLobeFloats);
    for (float number : numbers)
      if (number < 0) model.refuse("model", "numbers from 0 up");
    std::copy_n(numbers.begin(), kLobeFloats - 1, &lobes[b].angles[0].constant[0]);
    lobes[b].error = numbers.back();
    for (const LobeModel::Angle& angle : lobes[b].angles)
      if (!(angle.stretch > 0)) model.refuse("model", "stretches above 0");
  }
  return lobes;
}

std::string hexadecimal(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::uint64_t parse_hash(const JsonReader& reader, const char* key) {
  const std::string text = reader.text(key);
  if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    reader.refuse(key, "16 hexadecimal digits");
  return std::stoull(text, nullptr, 16);
}

MapVerdict parse_verdict(const JsonReader& reader) {
  const std::string name = reader.text("verdict");
  for (MapVerdict verdict : kVerdicts)
    if (name == verdict_name(verdict)) return verdict;
  reader.refuse("verdict", "reduces, one-material or does-not-reduce");
}

Json describe_origin(const ShaderOrigin& origin) {
  Json images = Json::object();
  for (const auto& [name, image] : origin.images) images[name] = {{"file", image.path}, {"is_data", image.is_data}};
  return {{"file", origin.file}, {"images", images}};
}

ShaderOrigin parse_origin(const Json& root, const std::string& where) {
  ShaderOrigin origin;
  if (!root.contains("shader_origin")) return origin;
  const JsonReader reader(root["shader_origin"], where + ": shader_origin");
  origin.file = reader.text("file");
  const Json& images = reader.get("images", "an object");
  const JsonReader image_reader(images, where + ": shader_origin: images");
  for (const auto& [name, image] : images.items()) {
    const JsonReader entry(image, fmt::format("{}: shader_origin: images: {}", where, name));
    origin.images[name] = {entry.text("file"), entry.boolean("is_data")};
  }
  return origin;
}

}  // namespace

std::string_view verdict_name(MapVerdict verdict) {
  switch (verdict) {
    case MapVerdict::kReduces:
      return "reduces";
    case MapVerdict::kOneMaterial:
      return "one-material";
    case MapVerdict::kDoesNotReduce:
      return "does-not-reduce";
  }
  return "unknown";
}

std::string describe_map(const ReductionMap& map) {
  Json basis = Json::array();
  for (const BasisPlace& p : map.basis) {
    basis.push_back({{"position", list(p.position)},
                     {"normal", list(p.normal)},
                     {"tangent", list(p.tangent)},
                     {"uv", {p.uv.x, p.uv.y}}});
    if (map.hides_frames) basis.back()["frame_z"] = list(p.frame_z), basis.back()["frame_x"] = list(p.frame_x);
  }
  Json lobes = Json::array();
  for (const LobeModel& model : map.lobes) lobes.push_back(lobe_list(model));
  Json parameters = Json::object();
  for (const auto& [name, value] : map.parameters) parameters[name] = value;
  Json description{{"format_version", kMapFormatVersion},
                   {"shader", map.shader},
                   {"shader_hash", hexadecimal(map.shader_hash)},
                   {"parameters", parameters},
                   {"surface", hexadecimal(map.surface_fingerprint)},
                   {"size", map.size},
                   {"tolerance", map.tolerance},
                   {"residual", map.residual},
                   {"verdict", verdict_name(map.verdict)},
                   {"verdict_reason", map.verdict_reason},
                   {"wraps_u", map.weights.wraps_u()},
                   {"scales", std::vector<float>(map.weights.scales().begin(), map.weights.scales().end())},
                   {"hides_frames", map.hides_frames},
                   {"basis", basis},
                   {"lobes", lobes}};
  if (!map.tangents.empty())
    description["tangent_scales"] = std::vector<float>(map.tangents.scales().begin(), map.tangents.scales().end());
  if (!map.shader_origin.file.empty()) description["shader_origin"] = describe_origin(map.shader_origin);
  if (map.certificate) description["certificate"] = describe(*map.certificate);
  return description.dump(-1, ' ', false, Json::error_handler_t::replace);
}

MapDescription parse_map_description(std::string_view json, const std::string& where) {
  const Json root = Json::parse(json, nullptr, false);
  if (root.is_discarded()) throw Error("{}: expected JSON in the attribute \"redmap\", found something else", where);
  const JsonReader reader(root, where);
  const double version = reader.number("format_version", 0, 1e9);
  if (version != kMapFormatVersion)
    throw Error("{}: format_version: expected {}, found {}", where, kMapFormatVersion, version);

  constexpr double kAnything = std::numeric_limits<float>::max();
  MapDescription description;
  ReductionMap& map = description.map;
  map.shader = reader.text("shader");
  map.shader_origin = parse_origin(root, where);
  map.shader_hash = parse_hash(reader, "shader_hash");
  const Json& parameters = reader.get("parameters", "an object");
  const JsonReader values(parameters, where + ": parameters");
  for (const auto& [name, value] : parameters.items()) map.parameters[name] = values.numbers(name.c_str(), 1, 3);
  map.surface_fingerprint = parse_hash(reader, "surface");
  map.size = static_cast<int>(reader.number("size", 1, 16384));
  map.tolerance = static_cast<float>(reader.number("tolerance", 0, kAnything));
  map.residual = static_cast<float>(reader.number("residual", 0, kAnything));
  map.verdict = parse_verdict(reader);
  map.verdict_reason = reader.text("verdict_reason");
  map.hides_frames = reader.boolean("hides_frames");
  map.basis = parse_basis(reader, where);
  map.lobes = parse_lobes(reader, map.basis.size(), where);
  description.scales = reader.numbers("scales", map.basis.size(), map.basis.size());
  for (float scale : description.scales)
    if (scale < 0) reader.refuse("scales", "numbers from 0 up");
  if (root.contains("tangent_scales"))
    description.tangent_scales = reader.numbers("tangent_scales", TangentMoments::kCount, TangentMoments::kCount);
  description.wraps_u = reader.boolean("wraps_u");
  if (root.contains("certificate")) map.certificate = parse_certificate(root["certificate"], where + ": certificate");
  return description;
}

}  // namespace redmap
