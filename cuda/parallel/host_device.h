#pragma once

// The macros of the fast path. HD marks a function for both the host and the device; without nvcc it
// is empty. SELDOM marks a function that ordinary scenes do not need: it is not inlined, so that it
// takes no registers and no space in the loops that may call it.

#if defined(__CUDACC__)
#define HD __host__ __device__
#define SELDOM __noinline__
#else
#define HD
#define SELDOM [[gnu::noinline]]
#endif
