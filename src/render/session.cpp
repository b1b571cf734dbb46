#include "render/session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "render/live_image.h"

namespace meander {
namespace {

using Clock = std::chrono::steady_clock;

// Seconds for which the first image of a job is kept from newer ones. Were it stopped by each, a stream of
// them would never show anything; every one that had to be stopped all the same doubles the next one's time.
constexpr double kFirstImageKept = 0.06;
constexpr double kFirstImageKeptAtMost = 1;

Clock::duration duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

// What callers and the worker share. Nothing slow ever happens under the mutex.
struct Session::Shared {
  mutable std::mutex mutex;
  std::condition_variable wake;   // of the worker
  std::condition_variable watch;  // of the watch
  std::optional<SessionRequest> pending;
  std::uint64_t generation = 0;  // of the newest submit()
  Clock::time_point submitted;
  std::optional<Budget> budget;  // a new one
  bool paused = false;
  bool quit = false;
  bool working = false;
  std::optional<Clock::time_point> kept_until;  // a first image is under way, and may take that long
  std::shared_ptr<const LiveFrame> frame;
  std::shared_ptr<const Rendering> film;
  std::uint64_t film_generation = 0;
  std::optional<std::string> error;
  std::atomic<bool> stop{false};
};

// The thread that renders, and a second one that stops a first image which takes longer than predicted while
// something newer waits.
class Session::Worker {
 public:
  Worker(Shared& shared, int threads) : shared_(shared) {
    stock_.threads = threads;
    watch_ = std::thread([this] { watch(); });
    thread_ = std::thread([this] { run(); });
  }
  ~Worker() {
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.quit = true;
      shared_.stop = true;
    }
    shared_.wake.notify_one();
    shared_.watch.notify_one();
    thread_.join();
    watch_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

 private:
  void run() {
    while (prepare()) {
      try {
        work();
      } catch (const std::exception& failure) {
        image_.reset();
        const std::lock_guard lock(shared_.mutex);
        shared_.error = failure.what();
        shared_.kept_until.reset();
      }
    }
  }

  // Waits until there is something to do, and takes it; false when the session ends.
  bool prepare() {
    std::unique_lock lock(shared_.mutex);
    const auto ready = [&] {
      if (shared_.budget && image_) image_->set_budget(*shared_.budget);
      shared_.budget.reset();
      shared_.working = shared_.pending || (image_ && image_->has_work(shared_.paused));
      return shared_.quit || shared_.working;
    };
    shared_.wake.wait(lock, ready);
    if (shared_.quit) return false;
    if (image_ && shared_.kept_until && !shared_.stop) return true;  // what is newer waits
    shared_.stop = false;
    shared_.kept_until.reset();
    request_ = std::exchange(shared_.pending, std::nullopt);
    if (!request_) return true;
    generation_ = shared_.generation;
    submitted_ = shared_.submitted;
    waited_ = seconds_between(submitted_, Clock::now());
    first_image_.reset();
    shared_.kept_until = Clock::now() + duration(keep_);
    return true;
  }

  void work() {
    if (request_) {
      image_.reset();
      image_.emplace(std::move(*request_), stock_);
      request_.reset();
    }
    publish(image_->step(shared_.stop));
  }

  void publish(const std::shared_ptr<LiveFrame>& frame) {
    const Clock::time_point now = Clock::now();
    if (frame && !first_image_) {
      first_image_ = seconds_between(submitted_, now);
      keep_ = kFirstImageKept;
    }
    if (frame) {
      frame->generation = generation_;
      frame->waited_seconds = waited_;
      frame->first_image_seconds = *first_image_;
    }
    std::shared_ptr<const LiveFrame> shown = frame;
    std::shared_ptr<const Rendering> film = image_->film();
    {
      const std::lock_guard lock(shared_.mutex);
      if (!first_image_ && shared_.stop) keep_ = std::min(2 * keep_, kFirstImageKeptAtMost);
      if (first_image_) shared_.kept_until.reset();
      if (shown) std::swap(shared_.frame, shown);
      if (film) shared_.film_generation = generation_;
      if (film) std::swap(shared_.film, film);
    }  // what they replace is let go here, outside the lock
  }

  void watch() {
    std::unique_lock lock(shared_.mutex);
    while (!shared_.quit) {
      if (!shared_.kept_until || !shared_.pending || shared_.stop) {
        shared_.watch.wait(lock);
      } else if (Clock::now() < *shared_.kept_until) {
        shared_.watch.wait_until(lock, *shared_.kept_until);
      } else {
        shared_.stop = true;
      }
    }
  }

  Shared& shared_;
  LiveStock stock_;
  std::optional<SessionRequest> request_;
  std::optional<LiveImage> image_;
  std::uint64_t generation_ = 0;
  Clock::time_point submitted_;
  double waited_ = 0;
  double keep_ = kFirstImageKept;
  std::optional<double> first_image_;  // seconds from submit(), once there is one
  std::thread watch_;
  std::thread thread_;
};

Session::Session(int threads, std::uint64_t generation) : shared_(std::make_unique<Shared>()) {
  shared_->generation = generation;
  worker_ = std::make_unique<Worker>(*shared_, threads);
}

Session::~Session() = default;

std::uint64_t Session::submit(SessionRequest request) {
  std::uint64_t generation = 0;
  {
    const std::lock_guard lock(shared_->mutex);
    const Clock::time_point now = Clock::now();
    const auto& kept = shared_->kept_until;
    if (!kept || now >= *kept) shared_->stop = true;
    std::swap(shared_->pending.emplace(), request);
    shared_->submitted = now;
    shared_->budget.reset();
    shared_->working = true;
    generation = ++shared_->generation;
  }
  shared_->wake.notify_one();
  shared_->watch.notify_one();
  return generation;
}

void Session::set_paused(bool paused) {
  {
    const std::lock_guard lock(shared_->mutex);
    if (paused && !shared_->kept_until) shared_->stop = true;
    shared_->paused = paused;
  }
  shared_->wake.notify_one();
}

void Session::set_budget(const Budget& budget) {
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->pending)
      shared_->pending->budget = budget;
    else
      shared_->budget = budget;
  }
  shared_->wake.notify_one();
}

std::shared_ptr<const LiveFrame> Session::latest() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->frame;
}

std::shared_ptr<const Rendering> Session::rendering(std::uint64_t generation) const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->film_generation == generation ? shared_->film : nullptr;
}

std::optional<std::string> Session::take_error() {
  const std::lock_guard lock(shared_->mutex);
  return std::exchange(shared_->error, std::nullopt);
}

bool Session::working() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->working;
}

}  // namespace meander
