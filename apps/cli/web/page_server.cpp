#include "web/page_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <map>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"

namespace redmap::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* kHost = "127.0.0.1";

std::string content_type(const fs::path& file) {
  static const std::map<std::string, std::string> kTypes{{".html", "text/html; charset=utf-8"},
                                                         {".js", "application/javascript"},
                                                         {".css", "text/css"},
                                                         {".json", "application/json"},
                                                         {".glsl", "text/plain; charset=utf-8"}};
  const auto found = kTypes.find(file.extension().string());
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

}  // namespace

struct PageServer::Impl {
  httplib::Server server;
  std::map<std::string, fs::path> files;  ///< by the path of their address
  int port = 0;

  void answer(const httplib::Request& request, httplib::Response& response) const {
    const auto found = files.find(request.path);
    if (found == files.end()) {
      response.status = 404;
      return;
    }
    // Another scene may stand at the same address next time.
    response.set_header("Cache-Control", "no-store");
    // By a provider, since texts would be packed anew for each answer, which takes longer than they do.
    const auto bytes = std::make_shared<const std::string>(read_file(found->second));
    response.set_content_provider(bytes->size(), content_type(found->second),
                                  [bytes](std::size_t from, std::size_t count, httplib::DataSink& sink) {
                                    return sink.write(bytes->data() + from, count);
                                  });
  }
};

PageServer::PageServer(const fs::path& folder, int port) : impl_(std::make_unique<Impl>()) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      impl_->files[fmt::format("/{}", entry.path().lexically_relative(folder).generic_string())] = entry.path();
  impl_->files["/"] = folder / "index.html";
  httplib::Server& server = impl_->server;
  server.Get(
      ".*", [this](const httplib::Request& request, httplib::Response& response) { impl_->answer(request, response); });
  // The library's own options let two programs share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  impl_->port = port == 0 ? server.bind_to_any_port(kHost) : server.bind_to_port(kHost, port) ? port : -1;
  if (impl_->port < 0) throw Error("view --web: expected port {} of {} to be free, found it in use", port, kHost);
}

PageServer::~PageServer() = default;

std::string PageServer::url() const { return fmt::format("http://{}:{}/", kHost, impl_->port); }

void PageServer::run(const std::function<bool()>& stop) {
  std::thread listening([this] { impl_->server.listen_after_bind(); });
  while (!stop()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  // It does not hear of stop() before it listens.
  while (!impl_->server.is_running() && listening.joinable()) std::this_thread::yield();
  impl_->server.stop();
  listening.join();
}

}  // namespace redmap::cli
