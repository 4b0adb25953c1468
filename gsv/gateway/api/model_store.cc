#include "gsv/gateway/api/model_store.h"

#include <set>
#include <utility>

#include "gsv/presentation/model_identity.h"
#include "gsv/presentation/scene_json.h"

namespace gsv::gateway {

std::string ModelStore::CachedIdentity(Identities ModelStore::*identities,
                                       const std::shared_ptr<const model::Model>& model,
                                       const std::function<std::string()>& identify) {
  {
    const base::MutexLock lock(mutex_);
    const auto known = (this->*identities).find(model);
    if (known != (this->*identities).end()) return known->second;
  }
  const std::string id = identify();
  const base::MutexLock lock(mutex_);
  ForgetDestroyed();
  (this->*identities).emplace(model, id);
  return id;
}

std::string ModelStore::Identify(const std::shared_ptr<const model::Model>& model) {
  return CachedIdentity(&ModelStore::visuals_, model,
                        [&] { return presentation::ModelIdentity(*model); });
}

std::string ModelStore::IdentifyCollisions(const std::shared_ptr<const model::Model>& model) {
  return CachedIdentity(&ModelStore::collisions_, model, [&] {
    return presentation::HasCollisions(*model)
               ? presentation::ModelIdentity(presentation::CollisionModel(*model))
               : std::string();
  });
}

base::Result<SharedBytes> ModelStore::Glb(const std::string& id) {
  std::shared_ptr<const model::Model> model;
  std::shared_ptr<File> file;
  {
    const base::MutexLock lock(mutex_);
    model = FindModel(id);
    if (!model) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "there is no model '" + id.substr(0, 64) + "' in any simulation");
    }
    std::shared_ptr<File>& known = files_[id];
    if (!known) known = std::make_shared<File>();
    file = known;
  }
  const base::MutexLock writing(file->writing);
  if (!file->glb) {
    auto bytes = write_(*model);
    if (bytes) {
      file->glb = SharedBytes(*std::move(bytes));
    } else {
      file->glb = base::Fail(std::move(bytes.error()));
    }
  }
  return *file->glb;
}

std::shared_ptr<const model::Model> ModelStore::FindIn(const Identities& identities,
                                                       const std::string& id) {
  for (const auto& [weak, identity] : identities) {
    if (identity != id) continue;
    if (std::shared_ptr<const model::Model> model = weak.lock()) return model;
  }
  return nullptr;
}

std::shared_ptr<const model::Model> ModelStore::FindModel(const std::string& id) const {
  if (id.empty()) return nullptr;
  if (auto model = FindIn(visuals_, id)) return model;
  const auto model = FindIn(collisions_, id);
  return model ? std::make_shared<const model::Model>(presentation::CollisionModel(*model))
               : nullptr;
}

void ModelStore::ForgetDestroyed() {
  std::set<std::string> alive;
  for (Identities* identities : {&visuals_, &collisions_}) {
    std::erase_if(*identities, [](const auto& known) { return known.first.expired(); });
    for (const auto& [model, id] : *identities) alive.insert(id);
  }
  std::erase_if(files_, [&](const auto& file) { return !alive.contains(file.first); });
}

}  // namespace gsv::gateway
