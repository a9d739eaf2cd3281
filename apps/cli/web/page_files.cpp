#include "web/page_files.h"

#include "base/error.h"

namespace redmap::cli {

namespace fs = std::filesystem;

fs::path page_folder() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  // A build has it beside the program, an installation beside bin.
  const fs::path below = fs::path("share") / "redmap" / "web";
  for (const fs::path& folder : {program.parent_path(), program.parent_path().parent_path()})
    if (fs::exists(folder / below / "index.html", failure)) return folder / below;
  throw Error(
      "view --web: expected the page in {}, found none: build redmap with -DREDMAP_BUILD_WEB=ON, which needs npm",
      (program.parent_path() / below).string());
}

}  // namespace redmap::cli
