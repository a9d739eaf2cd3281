// Files that are either wholly there or not at all: written beside their target, then renamed onto it.
#include "base/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "base/error.h"

namespace redmap {

namespace {

[[noreturn]] void fail(const char* verb, const std::filesystem::path& path, int error) {
  throw Error("{}: cannot {}: {}", path.string(), verb, std::strerror(error));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  if (std::filesystem::is_directory(target_)) fail("write", target_, EISDIR);
  // Several processes and threads may be writing the same target: the last to commit wins.
  static std::atomic<unsigned> count{0};
  temporary_ = target_;
  temporary_ += fmt::format(".{}.{}.tmp", ::getpid(), count++);
  file_ = std::fopen(temporary_.c_str(), "wbxe");
  if (!file_) fail("write", target_, errno);
}

AtomicFile::~AtomicFile() {
  if (file_) std::fclose(file_);
  std::error_code ignored;
  if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write", target_, errno);
}

void AtomicFile::commit() {
  // A full disk may only show when the buffers are emptied.
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail("write", target_, errno);
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail("write", target_, error.value());
  committed_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

std::string read_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) fail("read", path, EISDIR);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  if (!file) fail("read", path, errno);
  std::string bytes;
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file.get())) bytes.append(buffer, n);
  if (std::ferror(file.get())) fail("read", path, errno);
  return bytes;
}

}  // namespace redmap
