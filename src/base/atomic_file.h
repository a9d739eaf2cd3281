// Files that are either wholly there or not at all: written beside their target, then renamed onto it.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace redmap {

/// A file under construction: `write()` to it, or hand `path()` to a library that writes files and check its writes
/// and its close, then `commit()`. Without a commit the destructor removes what was written and the target stays as it
/// was.
class AtomicFile {
 public:
  /// Creates the empty temporary file in the folder of `target`. Throws Error where that folder cannot be written to.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  const std::filesystem::path& target() const { return target_; }
  /// Appends `bytes`. Throws Error, at the latest in `commit()`, where the disk is full.
  void write(std::string_view bytes);
  /// Closes the temporary file and renames it onto the target. Throws Error.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
  bool committed_ = false;
};

/// Writes `bytes` to `path`, atomically. Throws Error, also when the disk is full.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// All bytes of `path`. Throws Error.
std::string read_file(const std::filesystem::path& path);

}  // namespace redmap
