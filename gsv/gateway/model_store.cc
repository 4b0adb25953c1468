#include "gsv/gateway/model_store.h"

#include <set>
#include <utility>

#include "gsv/presentation/model_identity.h"

namespace gsv::gateway {

std::string ModelStore::Identify(const std::shared_ptr<const model::Model>& model) {
  {
    const std::lock_guard lock(mutex_);
    const auto known = identities_.find(model);
    if (known != identities_.end()) return known->second;
  }
  const std::string id = presentation::ModelIdentity(*model);
  const std::lock_guard lock(mutex_);
  ForgetGone();
  identities_.emplace(model, id);
  return id;
}

base::Result<SharedBytes> ModelStore::Glb(const std::string& id) {
  std::shared_ptr<const model::Model> model;
  std::shared_ptr<File> file;
  {
    const std::lock_guard lock(mutex_);
    model = FindModel(id);
    if (!model) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "there is no model '" + id.substr(0, 64) + "' in any simulation");
    }
    std::shared_ptr<File>& known = files_[id];
    if (!known) known = std::make_shared<File>();
    file = known;
  }
  const std::lock_guard writing(file->writing);
  if (!file->glb) {
    file->glb = write_(*model).map(
        [](std::vector<std::uint8_t> bytes) { return SharedBytes(std::move(bytes)); });
  }
  return *file->glb;
}

std::shared_ptr<const model::Model> ModelStore::FindModel(const std::string& id) const {
  for (const auto& [weak, identity] : identities_) {
    if (identity != id) continue;
    if (std::shared_ptr<const model::Model> model = weak.lock()) return model;
  }
  return nullptr;
}

void ModelStore::ForgetGone() {
  std::erase_if(identities_, [](const auto& known) { return known.first.expired(); });
  std::set<std::string> alive;
  for (const auto& [model, id] : identities_) alive.insert(id);
  std::erase_if(files_, [&](const auto& file) { return !alive.contains(file.first); });
}

}  // namespace gsv::gateway
