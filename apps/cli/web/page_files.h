// The page of apps/web, as the build or an installation has it.
#pragma once

#include <filesystem>

namespace redmap::cli {

/// The folder of the page: share/redmap/web beside this program, or beside the folder that it is in. Throws Error where
/// it was not built.
std::filesystem::path page_folder();

}  // namespace redmap::cli
