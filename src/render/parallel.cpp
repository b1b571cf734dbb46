#include "render/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#ifdef MEANDER_TSAN
// TBB itself is not instrumented, so this file is not either, and it says what TBB guarantees: what was
// written before the loop is seen in it, and what the loop wrote is seen after it.
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace meander {
namespace {

#ifdef MEANDER_TSAN
void release(char* mark) { __tsan_release(mark); }
void acquire(char* mark) { __tsan_acquire(mark); }
#else
void release(char*) {}
void acquire(char*) {}
#endif

constexpr int kNicer = 10;

// Makes the calling thread nicer than the process's first one. On Linux niceness is a thread's own.
void yield_to_others() {
  const int niceness = std::min(getpriority(PRIO_PROCESS, static_cast<id_t>(getpid())) + kNicer, 19);
  if (getpriority(PRIO_PROCESS, 0) < niceness) setpriority(PRIO_PROCESS, 0, niceness);
}

}  // namespace

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body,
                  Priority priority) {
  namespace tbb = oneapi::tbb;
  const int used = std::min(threads, hardware_threads());  // TBB warns of more
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(used));
  tbb::task_arena arena(used);
  char begun = 0;
  char ended = 0;
  release(&begun);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          acquire(&begun);
          if (priority == Priority::background) yield_to_others();
          for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
          release(&ended);
        },
        tbb::simple_partitioner());
  });
  acquire(&ended);
}

int hardware_threads() { return oneapi::tbb::info::default_concurrency(); }

}  // namespace meander
