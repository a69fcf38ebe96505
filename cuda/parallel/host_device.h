#pragma once

// The one macro of the fast path: marks what runs on the host and on the device alike. Without nvcc it
// says nothing.

#if defined(__CUDACC__)
#define HD __host__ __device__
#else
#define HD
#endif
