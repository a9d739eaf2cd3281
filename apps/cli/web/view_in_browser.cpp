// `redmap view --web`: the page of apps/web with a scene beside it, in a folder or served from one that goes away.
#include <fmt/format.h>
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "view_options.h"
#include "web/page_files.h"
#include "web/page_server.h"
#include "web/web_scene.h"

namespace redmap::cli {

namespace fs = std::filesystem;

namespace {

/// A folder that is gone with its object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "redmap-view.XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error("{}: cannot write a folder there", fs::temp_directory_path().string());
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void write_page(const ViewOptions& options, const fs::path& target) {
  const fs::path page = page_folder();
  ExportFolder folder(target);
  write_web_scene(options, folder);
  std::error_code failure;
  fs::copy(page, folder.path_of(""), fs::copy_options::recursive, failure);
  if (failure) throw Error("{}: cannot be copied to {}: {}", page.string(), target.string(), failure.message());
  const nlohmann::ordered_json manifest{{"redmap_export", 1}, {"kind", "web"}, {"scene", "scene/scene.json"}};
  folder.add(ExportFolder::kManifest, manifest.dump(2) + "\n");
  folder.commit();
}

}  // namespace

void view_in_browser(const ViewOptions& options) {
  if (!options.output.empty()) {
    write_page(options, options.output);
    fmt::print("{}\n", options.output);
    return;
  }
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "page";
  write_page(options, folder);
  PageServer server(folder, options.port);
  fmt::print("{}\n", server.url());
  std::fflush(stdout);  // for programs that wait for the address
  server.run(interrupted);
}

}  // namespace redmap::cli
