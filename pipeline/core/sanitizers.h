// Which sanitizer this is compiled for, 1 or 0: GCC defines a macro of its own, clang has a feature.
#pragma once

#ifdef __has_feature
#define HBR_HAS_FEATURE(name) __has_feature(name)
#else
#define HBR_HAS_FEATURE(name) 0
#endif

#if defined(__SANITIZE_THREAD__) || HBR_HAS_FEATURE(thread_sanitizer)
#define HBR_THREAD_SANITIZER 1
#else
#define HBR_THREAD_SANITIZER 0
#endif

#if defined(__SANITIZE_ADDRESS__) || HBR_HAS_FEATURE(address_sanitizer)
#define HBR_ADDRESS_SANITIZER 1
#else
#define HBR_ADDRESS_SANITIZER 0
#endif
