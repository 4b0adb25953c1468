// Loads a shared library at the first call of one of its functions, so that programs start faster.
// See tools/make_late_library.
//
// Threads  any.
#pragma once

extern "C" {

// Returns the function `name` of the library `file` (a soname, or a path), or of a library that
// `file` needs. Loads the library if it is not loaded, and never unloads it. If the library or the
// function is missing, prints the reason on stderr and exits with 127, as the dynamic linker does.
void* gsv_late_function(const char* file, const char* name) noexcept;
}
