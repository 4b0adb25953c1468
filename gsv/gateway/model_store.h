// The models of all simulations as GLB files, each made once, when it is first asked for.
//
// Threads  any; a call may take as long as a model takes to be written.
// Bounded  what belongs to models that are gone is forgotten.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/shared_bytes.h"
#include "gsv/model/model.h"

namespace gsv::gateway {

class ModelStore {
 public:
  using WriteGlb =
      std::function<base::Result<std::vector<std::uint8_t>>(const model::Model& model)>;

  explicit ModelStore(WriteGlb write) : write_(std::move(write)) {}

  // The model's identity, under which Glb() knows it from now on.
  std::string Identify(const std::shared_ptr<const model::Model>& model);

  // kNotFound: no model that is still alive was ever identified so.
  base::Result<SharedBytes> Glb(const std::string& id);

 private:
  struct File {
    std::mutex writing;
    std::optional<base::Result<SharedBytes>> glb;  // guarded by `writing`
  };

  // With mutex_ held.
  void ForgetGone();
  std::shared_ptr<const model::Model> FindModel(const std::string& id) const;

  const WriteGlb write_;
  std::mutex mutex_;
  std::map<std::weak_ptr<const model::Model>, std::string, std::owner_less<>> identities_;
  std::map<std::string, std::shared_ptr<File>> files_;  // by identity
};

}  // namespace gsv::gateway
