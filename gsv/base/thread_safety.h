// Annotations for clang's thread-safety analysis (-Wthread-safety; in tools/tidy every finding is
// an error). They are empty for other compilers.
//
// Source  https://clang.llvm.org/docs/ThreadSafetyAnalysis.html
#pragma once

#if defined(__clang__)
#define GSV_THREAD_ATTRIBUTE(x) __attribute__((x))
#else
#define GSV_THREAD_ATTRIBUTE(x)
#endif

// GSV_CAPABILITY marks a mutex class. GSV_SCOPED_CAPABILITY marks a class that locks a mutex for
// its lifetime.
#define GSV_CAPABILITY(name) GSV_THREAD_ATTRIBUTE(capability(name))
#define GSV_SCOPED_CAPABILITY GSV_THREAD_ATTRIBUTE(scoped_lockable)

// GSV_GUARDED_BY marks a member that may be accessed only while the mutex is locked.
// GSV_PT_GUARDED_BY marks a pointer whose target may be accessed only then.
#define GSV_GUARDED_BY(mutex) GSV_THREAD_ATTRIBUTE(guarded_by(mutex))
#define GSV_PT_GUARDED_BY(mutex) GSV_THREAD_ATTRIBUTE(pt_guarded_by(mutex))

// Declares that a thread must lock this mutex after the given mutexes.
#define GSV_ACQUIRED_AFTER(...) GSV_THREAD_ATTRIBUTE(acquired_after(__VA_ARGS__))

// Marks functions that require their caller to hold the mutex, or not to hold it, and functions
// that lock or unlock it.
#define GSV_REQUIRES(...) GSV_THREAD_ATTRIBUTE(requires_capability(__VA_ARGS__))
#define GSV_REQUIRES_SHARED(...) GSV_THREAD_ATTRIBUTE(requires_shared_capability(__VA_ARGS__))
#define GSV_EXCLUDES(...) GSV_THREAD_ATTRIBUTE(locks_excluded(__VA_ARGS__))
#define GSV_ACQUIRE(...) GSV_THREAD_ATTRIBUTE(acquire_capability(__VA_ARGS__))
#define GSV_ACQUIRE_SHARED(...) GSV_THREAD_ATTRIBUTE(acquire_shared_capability(__VA_ARGS__))
#define GSV_RELEASE(...) GSV_THREAD_ATTRIBUTE(release_capability(__VA_ARGS__))
#define GSV_RELEASE_SHARED(...) GSV_THREAD_ATTRIBUTE(release_shared_capability(__VA_ARGS__))
#define GSV_RELEASE_GENERIC(...) GSV_THREAD_ATTRIBUTE(release_generic_capability(__VA_ARGS__))
#define GSV_TRY_ACQUIRE(...) GSV_THREAD_ATTRIBUTE(try_acquire_capability(__VA_ARGS__))

// Declares that the mutex is held here, without a check at run time. Use it at the start of a
// lambda that is called while the mutex is locked.
#define GSV_ASSERT_HELD(...) GSV_THREAD_ATTRIBUTE(assert_capability(__VA_ARGS__))

// Marks functions that the analysis cannot check. A comment beside them gives the reason.
#define GSV_NO_THREAD_SAFETY_ANALYSIS GSV_THREAD_ATTRIBUTE(no_thread_safety_analysis)
