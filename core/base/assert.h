#pragma once

/// Stops the program with a sentence where one of our own rules is broken. Alive in the debug, asan and tsan
/// presets (BOXWOOD_ASSERTS); elsewhere the condition is not evaluated. Never for input from outside: see
/// error.h.
#ifdef BOXWOOD_ASSERTS
#define BOXWOOD_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::boxwood::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define BOXWOOD_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif

namespace boxwood {

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace boxwood
