#include "view/rebake.h"

#include "bake/bake.h"
#include "base/error.h"

namespace redmap::cli {

void Rebake::stop() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

void Rebake::start(const std::string& scene, const std::vector<std::string>& overrides, const std::string& device,
                   const std::vector<Wanted>& objects) {
  stop();
  cancelled_ = false, done_ = false;
  result_.reset(), error_.clear();
  thread_ = std::thread([this, scene, overrides, device, objects] {
    try {
      RebakedScene result{SceneFile::load(scene, overrides, device), {}};
      const Scene changed = result.file.at(1);
      BakeOptions options;
      options.progress = [this](float, std::string_view) { return !cancelled_; };
      for (const Wanted& wanted : objects) {
        const Object& object = changed.objects.at(wanted.object);
        options.size = wanted.size;
        auto map = std::make_shared<const ReductionMap>(bake(*object.surface, *object.shader, options));
        result.maps.push_back({wanted.object, std::move(map)});
      }
      result_ = std::move(result);
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
