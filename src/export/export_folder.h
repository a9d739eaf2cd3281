// The files of an export: a folder that is either wholly there or not at all, written beside its place, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace redmap {

class ExportFolder {
 public:
  /// What every export ends with, and what tells it from other folders.
  static constexpr std::string_view kManifest = "manifest.json";

  /// Throws Error where `target` is something else than an earlier export or an empty folder: it would be replaced.
  explicit ExportFolder(const std::filesystem::path& target);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  /// Throws Error, also when the disk is full.
  void add(std::string_view name, std::string_view bytes);
  /// Where a library is to write a file of that name.
  std::filesystem::path path_of(std::string_view name) const { return temporary_ / name; }
  /// Puts everything in its place. Throws Error.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
};

}  // namespace redmap
