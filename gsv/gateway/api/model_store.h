// A ModelStore provides the models of all simulations as GLB files. It writes each file at the
// first request.
//
// Threads  any; a call may take as long as writing a model.
// Bounded  data of destroyed models are removed.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/model/model.h"

namespace gsv::gateway {

// Provides models as GLB files.
class ModelStore {
 public:
  using WriteGlb =
      std::function<base::Result<std::vector<std::uint8_t>>(const model::Model& model)>;

  explicit ModelStore(WriteGlb write) : write_(std::move(write)) {}

  // Returns the identifier of the model, for Glb().
  std::string Identify(const std::shared_ptr<const model::Model>& model);
  // Returns the identifier of the model's collision shapes, or an empty text if it has none.
  std::string IdentifyCollisions(const std::shared_ptr<const model::Model>& model);

  // identify() and identify_collisions() return function objects that call Identify() and
  // IdentifyCollisions(), for SceneJson(). They are valid during the lifetime of this object.
  std::function<std::string(const std::shared_ptr<const model::Model>&)> identify() {
    return [this](const auto& model) { return Identify(model); };
  }
  std::function<std::string(const std::shared_ptr<const model::Model>&)> identify_collisions() {
    return [this](const auto& model) { return IdentifyCollisions(model); };
  }

  // Returns the GLB of a model; kNotFound if no existing model has this identifier.
  base::Result<SharedBytes> Glb(const std::string& id);

 private:
  // The GLB file of a model. The first request writes it, while later requests wait.
  struct File {
    base::Mutex writing;  // locked while the file is written
    // The file, or the error of writing it; nullopt before it is written.
    std::optional<base::Result<SharedBytes>> glb GSV_GUARDED_BY(writing);
  };

  // Removes the identifiers and files of destroyed models.
  void ForgetDestroyed() GSV_REQUIRES(mutex_);
  // Returns the model with this identifier, or null.
  std::shared_ptr<const model::Model> FindModel(const std::string& id) const GSV_REQUIRES(mutex_);

  const WriteGlb write_;
  base::Mutex mutex_;
  // Identifiers of models, by model. They do not keep the models alive.
  using Identities = std::map<std::weak_ptr<const model::Model>, std::string, std::owner_less<>>;

  // Returns the cached identifier of a model, or calls `identify`, which may take long.
  std::string CachedIdentity(Identities ModelStore::*identities,
                             const std::shared_ptr<const model::Model>& model,
                             const std::function<std::string()>& identify);
  // Returns the model with this identifier, or null.
  static std::shared_ptr<const model::Model> FindIn(const Identities& identities,
                                                    const std::string& id);

  Identities visuals_ GSV_GUARDED_BY(mutex_);     // identifiers from Identify()
  Identities collisions_ GSV_GUARDED_BY(mutex_);  // identifiers from IdentifyCollisions()
  std::map<std::string, std::shared_ptr<File>> files_ GSV_GUARDED_BY(mutex_);  // by identity
};

}  // namespace gsv::gateway
