#include "export/export_folder.h"

#include <unistd.h>

#include <string>

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
  std::error_code failure;
  // An earlier export steps aside: at no moment is a folder of that name half old and half new.
  const fs::path before = temporary_.string() + ".old";
  if (fs::exists(target_)) fs::rename(target_, before, failure);
  if (!failure) fs::rename(temporary_, target_, failure);
  if (failure) throw Error("{}: cannot be replaced: {}", target_.string(), failure.message());
  fs::remove_all(before, failure);
}

}  // namespace redmap
