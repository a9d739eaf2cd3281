// Files for a browser on this machine, and for nobody else.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace redmap::cli {

/// Answers GET of the files that `folder` holds now, on 127.0.0.1.
class PageServer {
 public:
  /// `port`: 0 for any that is free. Throws Error where it cannot be had.
  PageServer(const std::filesystem::path& folder, int port);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  std::string url() const;
  /// Until `stop` says so, which is asked several times a second.
  void run(const std::function<bool()>& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace redmap::cli
