#include "apps/gsv/machine/sandbox.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "gsv/base/sanitizer.h"

namespace {

[[maybe_unused]] bool is_in_sandbox = false;

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
// LeakSanitizer calls this function, and does nothing if it returns true. A check for leaks would
// trace this process, which the sandbox does not allow.
extern "C" int __lsan_is_turned_off() { return is_in_sandbox; }
#endif

namespace gsv::app {
namespace {

// The system calls that fail in the sandbox. Reading a file needs none of them.
constexpr int kRefused[] = {
    SYS_socket,           SYS_socketpair, SYS_connect,  SYS_bind,   SYS_listen,
    SYS_accept4,          SYS_execve,     SYS_execveat, SYS_fork,   SYS_vfork,
    SYS_ptrace,           SYS_kill,       SYS_setuid,   SYS_mount,  SYS_process_vm_writev,
    SYS_process_vm_readv, SYS_unlink,     SYS_unlinkat, SYS_rename, SYS_renameat2,
    SYS_io_uring_setup};

// A classic BPF filter (seccomp(2)). Refused calls fail with EPERM. Calls of other architectures
// kill the process.
std::vector<sock_filter> Filter() {
  std::vector<sock_filter> filter{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
  };
  for (const int call : kRefused) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  return filter;
}

bool Bound(__rlimit_resource resource, rlim_t most) {
  const rlimit limit{most, most};
  return setrlimit(resource, &limit) == 0;
}

}  // namespace

base::Status EnterSandbox(const Sandbox& bounds) {
  const bool is_bound = (base::kReservesAddressSpace || Bound(RLIMIT_AS, bounds.memory_bytes)) &&
                        Bound(RLIMIT_CPU, static_cast<rlim_t>(bounds.processor_time.count())) &&
                        Bound(RLIMIT_FSIZE, 0) && Bound(RLIMIT_CORE, 0);
  // A library may try to write a log file. The write then fails because of the size limit. If the
  // signal were not ignored, the kernel would kill the process.
  std::signal(SIGXFSZ, SIG_IGN);
  // If memory is exhausted, the process exits. It does not throw bad_alloc, because a reader of
  // files would report the exception as an error in the file.
  std::set_new_handler([] { _exit(kWantsMoreMemory); });
  std::vector<sock_filter> filter = Filter();
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  if (is_bound && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0) {
    is_in_sandbox = true;
    return {};
  }
  return base::Fail(
      base::ErrorCode::kUnavailable,
      std::string("cannot limit the resources of this process: ") + std::strerror(errno));
}

}  // namespace gsv::app
