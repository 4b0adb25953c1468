#include "gsv/formats/sdf/shared_regex.h"

#include <locale>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <utility>

#include "gsv/base/mutex.h"

// The linker option --undefined requests this symbol, so that the linker includes this file.
extern "C" const char gsv_shared_regex = 0;

#ifdef __GLIBCXX__

namespace gsv::formats {
namespace {

using Traits = std::regex_traits<char>;
using Flags = std::regex_constants::syntax_option_type;
// The compiled form of an expression. It never changes, so that expressions may share it.
using Automaton = std::shared_ptr<const std::__detail::_NFA<Traits>>;

struct Compiled {
  base::Mutex mutex;
  std::map<std::pair<std::string, unsigned>, Automaton> automata GSV_GUARDED_BY(mutex);
};

// The object is never destroyed, because destructors of other files may compile expressions.
Compiled& AllCompiled() {
  static Compiled& compiled = *new Compiled;
  return compiled;
}

Automaton Compile(const char* first, const char* last, const std::locale& locale, Flags flags) {
  return std::__detail::_Compiler<Traits>(first, last, locale, flags)._M_get_nfa();
}

Automaton CompileOnce(const char* first, const char* last, const std::locale& locale, Flags flags) {
  // Expressions in another locale are not shared, because their meaning may depend on the locale.
  if (locale != std::locale::classic()) return Compile(first, last, locale, flags);
  Compiled& compiled = AllCompiled();
  const std::pair key(std::string(first, last), static_cast<unsigned>(flags));
  {
    const base::MutexLock lock(compiled.mutex);
    const auto known = compiled.automata.find(key);
    if (known != compiled.automata.end()) return known->second;
  }
  Automaton automaton = Compile(first, last, locale, flags);
  const base::MutexLock lock(compiled.mutex);
  if (compiled.automata.size() < kMaxSharedRegexes) compiled.automata.emplace(key, automaton);
  return automaton;
}

}  // namespace

std::size_t SharedRegexCount() {
  Compiled& compiled = AllCompiled();
  const base::MutexLock lock(compiled.mutex);
  return compiled.automata.size();
}

// libstdc++'s function before GCC 12, std::__detail::__compile_nfa<std::regex_traits<char>, const
// char*>(), which libsdformat calls. Current headers do not declare it.
Automaton
CompileNfa(const char* first, const char* last, const std::locale& locale, Flags flags) __asm__(
    "_ZNSt8__detail13__compile_nfaINSt7__cxx1112regex_traitsIcEEPKcEENSt9enable_ifIXsrNS_20__is_"
    "contiguous_"
    "iterIT0_EE5valueESt10shared_ptrIKNS_4_NFAIT_EEEE4typeES8_S8_RKNSC_11locale_typeENSt15regex_"
    "constants18syntax_"
    "option_typeE");
Automaton CompileNfa(const char* first, const char* last, const std::locale& locale, Flags flags) {
  return CompileOnce(first, last, locale, flags);
}

}  // namespace gsv::formats

// The function of current versions of libstdc++. libignition-math and this program call it.
template <>
void std::basic_regex<char>::_M_compile(const char* first, const char* last, flag_type flags) {
  _M_automaton = gsv::formats::CompileOnce(first, last, _M_loc, flags);
  _M_flags = flags;
}

#else

std::size_t gsv::formats::SharedRegexCount() { return 0; }

#endif
