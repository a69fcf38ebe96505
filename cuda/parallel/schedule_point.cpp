#include "cuda/parallel/atomic.h"

namespace fast {

constinit thread_local SchedulePoint schedule_point = nullptr;

} // namespace fast
