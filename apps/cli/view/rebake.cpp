#include "view/rebake.h"

#include "bake/bake.h"
#include "base/error.h"

namespace redmap::cli {

void Rebake::stop() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

void Rebake::start(const std::string& scene, const std::vector<std::string>& overrides, const std::string& device,
                   std::size_t object, int size) {
  stop();
  cancelled_ = false, done_ = false;
  result_.reset(), error_.clear();
  thread_ = std::thread([this, scene, overrides, device, object, size] {
    try {
      SceneFile file = SceneFile::load(scene, overrides, device);
      const Scene changed = file.at(1);
      const Object& baked = changed.objects.at(object);
      BakeOptions options;
      options.size = size;
      options.progress = [this](float, std::string_view) { return !cancelled_; };
      auto map = std::make_shared<const ReductionMap>(bake(*baked.surface, *baked.shader, options));
      result_.emplace(RebakedScene{std::move(file), object, std::move(map)});
    } catch (const BakeInterrupted&) {
    } catch (const std::exception& error) {
      error_ = error.what();
    }
    done_ = true;
  });
}

std::optional<RebakedScene> Rebake::take() {
  if (!thread_.joinable() || !done_) return std::nullopt;
  thread_.join();
  if (!error_.empty()) throw Error("{}", error_);
  return std::move(result_);
}

}  // namespace redmap::cli
