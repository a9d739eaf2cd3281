#include "export/export_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"

namespace redmap {

namespace fs = std::filesystem;

namespace {

bool may_be_replaced(const fs::path& target) {
  if (!fs::exists(target)) return true;
  return fs::is_directory(target) && (fs::is_empty(target) || fs::exists(target / ExportFolder::kManifest));
}

}  // namespace

ExportFolder::ExportFolder(const fs::path& target) : target_(fs::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (!may_be_replaced(target_))
    throw Error("{}: expected no such folder, an empty one or an earlier export, found something else",
                target_.string());
  std::error_code failure;
  fs::create_directories(target_.parent_path(), failure);
  // Beside the target, so that it can be renamed; hidden, and removed whatever happens short of a crash.
  std::string name = fmt::format("{}/.{}.XXXXXX", target_.parent_path().string(), target_.filename().string());
  if (failure || !mkdtemp(name.data())) throw Error("{}: cannot write a folder there", target_.parent_path().string());
  temporary_ = name;
  fs::permissions(temporary_,
                  fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec,
                  fs::perm_options::add);
}

ExportFolder::~ExportFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void ExportFolder::add(std::string_view name, std::string_view bytes) { write_file(temporary_ / name, bytes); }

void ExportFolder::commit() {
  const auto rename = [&](unsigned flags) {
    return renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), flags) == 0;
  };
  // An earlier export and this one change places in one step: whoever is killed, the folder is one of them, whole. The
  // earlier one, under the temporary name then, is removed with this object.
  bool done = rename(fs::exists(target_) ? RENAME_EXCHANGE : RENAME_NOREPLACE);
  // Some network file systems know no such step: there the folder is away for a moment.
  if (!done && errno == EINVAL) {
    const fs::path before = temporary_.string() + ".old";
    std::error_code failure;
    if (fs::exists(target_)) fs::rename(target_, before, failure);
    done = rename(0);
    fs::remove_all(before, failure);
  }
  if (!done) throw Error("{}: cannot be replaced: {}", target_.string(), std::generic_category().message(errno));
}

}  // namespace redmap
