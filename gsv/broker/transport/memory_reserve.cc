#include "gsv/broker/transport/memory_reserve.h"

#include <new>

#include <malloc.h>
#include <omniORB4/CORBA.h>
#include <sys/mman.h>

#include "gsv/base/mutex.h"

namespace gsv::broker {
namespace {

// A reserved range of addresses. After it is freed, both objects and stacks of threads can use it.
class Reserve {
 public:
  explicit Reserve(std::size_t bytes) : bytes_(bytes) { (void)Refill(); }

  // Reserves the range if necessary. Returns true if the range is reserved, or if the heap has as
  // much free memory.
  bool Refill() {
    const base::MutexLock lock(mutex_);
    if (range_ != MAP_FAILED) return true;
    range_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return range_ != MAP_FAILED || mallinfo2().fordblks >= bytes_;
  }

  // Frees the range. Returns false if it was not reserved.
  bool Release() {
    const base::MutexLock lock(mutex_);
    if (range_ == MAP_FAILED) return false;
    munmap(range_, bytes_);
    range_ = MAP_FAILED;
    return true;
  }

 private:
  const std::size_t bytes_;
  base::Mutex mutex_;
  void* range_ GSV_GUARDED_BY(mutex_) = MAP_FAILED;
};

// Never destroyed, because threads of the ORB may outlive main().
Reserve* g_reserve = nullptr;

}  // namespace

void HoldMemoryReserve(std::size_t bytes) {
  if (g_reserve != nullptr) return;
  g_reserve = new Reserve(bytes);
  std::set_new_handler([] {
    if (!g_reserve->Release()) throw std::bad_alloc();
  });
}

void RequireMemoryReserve() {
  if (g_reserve != nullptr && !g_reserve->Refill()) {
    throw CORBA::NO_MEMORY(0, CORBA::COMPLETED_NO);
  }
}

}  // namespace gsv::broker
