#include "user_shader/materialx.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "user_shader/materialx_script.h"

namespace redmap {
namespace {

std::string python_program() {
  const char* chosen = std::getenv("REDMAP_PYTHON");
  return chosen && *chosen ? chosen : "python3";
}

/// The read end of a pipe, and what a child does to write to it and nowhere else.
class ChildOutput {
 public:
  ChildOutput() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw Error("MaterialX: expected a pipe to Python, found none");
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, ends_[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  ~ChildOutput() {
    posix_spawn_file_actions_destroy(&actions_);
    for (const int end : ends_)
      if (end >= 0) close(end);
  }
  ChildOutput(const ChildOutput&) = delete;
  ChildOutput& operator=(const ChildOutput&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  /// All that the child writes, until it ends.
  std::string read_all() {
    close(ends_[1]);
    ends_[1] = -1;
    std::string all;
    std::array<char, 65536> block{};
    for (ssize_t got = 0; (got = read(ends_[0], block.data(), block.size())) > 0 || (got < 0 && errno == EINTR);)
      if (got > 0) all.append(block.data(), static_cast<std::size_t>(got));
    return all;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  posix_spawn_file_actions_t actions_{};
};

/// What the script prints about `file`; empty where Python failed.
std::string ask_python(const std::string& python, const std::string& file) {
  ChildOutput output;
  std::array<std::string, 4> words{python, "-c", materialx_script(), file};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, python.c_str(), output.actions(), nullptr, arguments.data(), environ) != 0) return {};
  std::string printed = output.read_all();
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return printed;
}

MaterialxShader translate(const std::string& file) {
  const std::string python = python_program();
  const nlohmann::json answer = nlohmann::json::parse(ask_python(python, file), nullptr, /*allow_exceptions=*/false);
  if (!answer.is_object())
    throw Error("{}: expected the program {} with MaterialX (pip install materialx, REDMAP_PYTHON), found it failing",
                file, python);
  if (answer.contains("error")) throw Error(answer["error"].get<std::string>());
  return {answer.at("text").get<std::string>(), answer.at("images").get<std::map<std::string, std::string>>()};
}

/// What tells versions of a file apart without reading it.
struct FileVersion {
  std::filesystem::file_time_type written;
  std::uintmax_t size = 0;
  friend bool operator==(const FileVersion&, const FileVersion&) = default;
};

}  // namespace

std::filesystem::path materialx_document(const std::filesystem::path& file) {
  constexpr std::string_view kEnd = ".mtlx";
  const std::string text = file.string();
  const std::size_t name = text.rfind(std::string(kEnd) + "#");
  return name == std::string::npos ? file : std::filesystem::path(text.substr(0, name + kEnd.size()));
}

bool is_materialx(const std::filesystem::path& file) { return materialx_document(file).extension() == ".mtlx"; }

MaterialxShader translate_materialx(const std::filesystem::path& file) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, std::pair<FileVersion, MaterialxShader>> translated;
  const std::scoped_lock lock(mutex);
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  const std::filesystem::path document = materialx_document(path);
  const FileVersion version{std::filesystem::last_write_time(document), std::filesystem::file_size(document)};
  const auto known = translated.find(path);
  if (known != translated.end() && known->second.first == version) return known->second.second;
  MaterialxShader shader = translate(file.lexically_normal().string());
  translated[path] = {version, shader};
  return shader;
}

}  // namespace redmap
