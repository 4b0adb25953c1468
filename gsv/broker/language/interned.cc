#include "gsv/broker/language/interned.h"

#include <map>

#include "gsv/base/mutex.h"

namespace gsv::broker {

template <typename T>
struct Interned<T>::Pool {
  base::Mutex mutex;
  std::map<T, std::atomic<std::size_t>> values
      GSV_GUARDED_BY(mutex);  // with their numbers of users
};

// Never deleted, because static objects may have values.
template <typename T>
typename Interned<T>::Pool& Interned<T>::ThePool() {
  static Pool& pool = *new Pool;
  return pool;
}

template <typename T>
const T Interned<T>::kDefault{};

template <typename T>
Interned<T>::Interned(T value) {
  if (value == kDefault) return;
  Pool& pool = ThePool();
  const base::MutexLock lock(pool.mutex);
  stored_ = &*pool.values.try_emplace(std::move(value), 0).first;
  stored_->second.fetch_add(1, std::memory_order_relaxed);
}

template <typename T>
void Interned<T>::Release() {
  std::size_t users = stored_->second.load(std::memory_order_relaxed);
  while (users > 1) {
    if (stored_->second.compare_exchange_weak(users, users - 1, std::memory_order_acq_rel)) return;
  }
  Pool& pool = ThePool();
  const base::MutexLock lock(pool.mutex);
  if (stored_->second.fetch_sub(1, std::memory_order_acq_rel) > 1) return;
  pool.values.erase(pool.values.find(stored_->first));
}

template <typename T>
std::size_t Interned<T>::Count() {
  Pool& pool = ThePool();
  const base::MutexLock lock(pool.mutex);
  return pool.values.size();
}

template class Interned<std::string>;
template class Interned<std::vector<std::string>>;

}  // namespace gsv::broker
