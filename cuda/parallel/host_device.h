#pragma once

// The macros of the fast path. HD marks what runs on the host and on the device alike; without nvcc it
// says nothing. SELDOM marks what ordinary scenes do not need: it is not inlined, so that it takes no
// registers and no room in the loops that might call it.

#if defined(__CUDACC__)
#define HD __host__ __device__
#define SELDOM __noinline__
#else
#define HD
#define SELDOM [[gnu::noinline]]
#endif
