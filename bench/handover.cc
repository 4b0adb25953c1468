// Measures the shortest time that a call to another process on the same machine can take: two
// processes wake each other by a futex. Prints the duration of one round trip in ns.
//
// usage: handover [REPETITIONS]
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

using Word = std::atomic<std::uint32_t>;

void Futex(Word& word, int operation, std::uint32_t value) {
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), operation, value, nullptr, nullptr,
          0);
}

void Await(Word& word, std::uint32_t value) {
  for (std::uint32_t now = word; now != value; now = word) Futex(word, FUTEX_WAIT, now);
}

void Set(Word& word, std::uint32_t value) {
  word = value;
  Futex(word, FUTEX_WAKE, 1);
}

}  // namespace

int main(int argc, char** argv) {
  const long repetitions = argc > 1 ? std::atol(argv[1]) : 100000;
  void* memory = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED || repetitions < 1) return 2;
  Word& word = *new (memory) Word(0);
  const pid_t other = fork();
  if (other < 0) return 5;
  if (other == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (long i = 0; i < repetitions; ++i) {
      Await(word, 1);
      Set(word, 0);
    }
    _exit(0);
  }
  const auto start = std::chrono::steady_clock::now();
  for (long i = 0; i < repetitions; ++i) {
    Set(word, 1);
    Await(word, 0);
  }
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  waitpid(other, nullptr, 0);
  std::printf("%.0f\n", taken.count() / static_cast<double>(repetitions));
}
