#include "gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cassert>
#include <cctype>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "gl/display_loss.h"
#include "gl/pinned_driver.h"

namespace meander {
namespace {

constexpr double kBlocked = 0.25;  // seconds in a swap: no monitor refreshes this slowly

struct CloseWindow {
  void operator()(GLFWwindow* window) const noexcept { glfwDestroyWindow(window); }
};
using Handle = std::unique_ptr<GLFWwindow, CloseWindow>;

std::string last_complaint() {
  const char* text = nullptr;
  if (glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr) return "no reason given";
  return text;
}

// Lives as long as the window library may be called.
struct Library {
  Library() {
    if (glfwInit() == GLFW_TRUE) return;
    throw Error(Fault::runtime, "there is no display to open a window on (" + last_complaint() +
                                    "); without one, use: meander capture SCENE -o OUT.png");
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { glfwTerminate(); }
};

Handle try_open(const Extent& size, const std::string& title, int robustness) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // nothing here draws with depth
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);  // the desktop must not shine through
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  return Handle(glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr));
}

Handle open(const Extent& size, const std::string& title) {
  Handle window = try_open(size, title, GLFW_LOSE_CONTEXT_ON_RESET);
  if (!window) window = try_open(size, title, GLFW_NO_ROBUSTNESS);
  if (window) return window;
  throw Error(Fault::runtime, "this display gives no window with an OpenGL 3.3 core context (" +
                                  last_complaint() + "); without one, use: meander capture SCENE -o OUT.png");
}

void* entry_point(const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }

Modifiers modifiers_of(int bits) {
  return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0,
          (bits & GLFW_MOD_SUPER) != 0};
}

Modifiers held_modifiers(GLFWwindow* window) {
  const auto held = [window](int left, int right) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
  };
  return {held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
          held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL), held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT),
          held(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER)};
}

// GLFW names keys by their place on a US keyboard. A letter is the one printed on the user's key, and a place
// of a letter that has another sign on it is that sign; digits stay where they are, whatever is printed
// there.
int key_code(int key, int scancode) {
  if (key < GLFW_KEY_SPACE || key > GLFW_KEY_WORLD_2) return key;
  const char* name = glfwGetKeyName(key, scancode);
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return key;
  const auto sign = static_cast<unsigned char>(name[0]);
  if (sign >= 128) return key;
  if (std::isalpha(sign) != 0) return std::toupper(sign);
  return key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? sign : key;
}

using Events = std::vector<InputEvent>;

// What has happened, and where the pointer was then. The library, when asked for the pointer, says where it
// is by now: a press that is taken up late would land where the drag has got to.
struct Inbox {
  Events events;
  double x = 0;
  double y = 0;
};

Inbox& inbox_of(GLFWwindow* window) { return *static_cast<Inbox*>(glfwGetWindowUserPointer(window)); }
Events& events_of(GLFWwindow* window) { return inbox_of(window).events; }

InputEvent at_pointer(GLFWwindow* window, InputKind kind) {
  InputEvent event;
  event.kind = kind;
  event.x = inbox_of(window).x;
  event.y = inbox_of(window).y;
  event.modifiers = held_modifiers(window);
  return event;
}

void on_move(GLFWwindow* window, double x, double y) {
  Events& events = events_of(window);
  inbox_of(window).x = x;
  inbox_of(window).y = y;
  if (!events.empty() && events.back().kind == InputKind::move) {  // only where it is now counts
    events.back().x = x;
    events.back().y = y;
    return;
  }
  events.push_back(at_pointer(window, InputKind::move));
}

void on_enter(GLFWwindow* window, int entered) {
  if (entered != 0) glfwGetCursorPos(window, &inbox_of(window).x, &inbox_of(window).y);
  events_of(window).push_back(at_pointer(window, entered != 0 ? InputKind::move : InputKind::leave));
}

void on_button(GLFWwindow* window, int button, int action, int modifiers) {
  InputEvent event = at_pointer(window, InputKind::button);
  event.code = button;
  event.down = action == GLFW_PRESS;
  event.modifiers = modifiers_of(modifiers);
  events_of(window).push_back(std::move(event));
}

void on_scroll(GLFWwindow* window, double x, double y) {
  InputEvent event = at_pointer(window, InputKind::scroll);
  event.x = x;
  event.y = y;
  events_of(window).push_back(std::move(event));
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  if (key == GLFW_KEY_UNKNOWN) return;
  InputEvent event;
  event.kind = InputKind::key;
  event.code = key_code(key, scancode);
  event.down = action != GLFW_RELEASE;
  event.modifiers = modifiers_of(modifiers);
  events_of(window).push_back(std::move(event));
}

void on_text(GLFWwindow* window, unsigned int character) {
  InputEvent event;
  event.kind = InputKind::text;
  event.character = static_cast<char32_t>(character);
  events_of(window).push_back(std::move(event));
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  InputEvent event = at_pointer(window, InputKind::drop);
  event.paths.assign(paths, paths + count);
  events_of(window).push_back(std::move(event));
}

void on_focus(GLFWwindow* window, int focused) {
  InputEvent event;
  event.kind = InputKind::focus;
  event.down = focused != 0;
  events_of(window).push_back(std::move(event));
}

void push_redraw(GLFWwindow* window) {
  InputEvent event;
  event.kind = InputKind::redraw;
  events_of(window).push_back(std::move(event));
}

void listen(GLFWwindow* window) {
  glfwSetCursorPosCallback(window, on_move);
  glfwSetCursorEnterCallback(window, on_enter);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetScrollCallback(window, on_scroll);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_text);
  glfwSetDropCallback(window, on_drop);
  glfwSetWindowFocusCallback(window, on_focus);
  glfwSetWindowRefreshCallback(window, push_redraw);
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* resized, int, int) { push_redraw(resized); });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* moved, float, float) { push_redraw(moved); });
}

PFNGLGETGRAPHICSRESETSTATUSARBPROC reset_status_of_context() {
  // Asked for by its extension: the loader has an address for every name, supported or not.
  if (glfwExtensionSupported("GL_ARB_robustness") != GLFW_TRUE) return nullptr;
  return reinterpret_cast<PFNGLGETGRAPHICSRESETSTATUSARBPROC>(
      glfwGetProcAddress("glGetGraphicsResetStatusARB"));
}

constexpr std::array<int, 6> kShapes{GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR,   GLFW_CROSSHAIR_CURSOR,
                                     GLFW_HAND_CURSOR,  GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR};

}  // namespace

struct Window::State {
  DisplayLoss loss;
  Library library;
  Handle window;
  Inbox inbox;
  Functions functions;
  PFNGLGETGRAPHICSRESETSTATUSARBPROC reset_status = nullptr;
  std::array<GLFWcursor*, kShapes.size()> cursors{};  // made when first shown; they go with the library
  Cursor shown = Cursor::arrow;
  bool waits_for_monitor = true;
};

Window::Window(const Extent& size, const std::string& title) : state_(std::make_unique<State>()) {
  assert(size.width > 0 && size.height > 0);
  state_->window = open(size, title);
  state_->loss.watch_errors();  // after the library's own handlers of the creation
  GLFWwindow* window = state_->window.get();
  const auto scaled = [scale = content_scale()](int points) {
    return static_cast<int>(scale * static_cast<float>(points));
  };
  glfwSetWindowSizeLimits(window, scaled(kSmallest.width), scaled(kSmallest.height), GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window, &state_->inbox);
  listen(window);
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  state_->functions = load_functions(entry_point);
  pin_drivers();
  state_->reset_status = reset_status_of_context();
}

Window::~Window() = default;

const Functions& Window::functions() const noexcept { return state_->functions; }

void Window::make_current() const { glfwMakeContextCurrent(state_->window.get()); }

void Window::bind() const {
  const Extent pixels = framebuffer_size();
  state_->functions.bind_framebuffer(GL_FRAMEBUFFER, 0);
  state_->functions.viewport(0, 0, pixels.width, pixels.height);
}

void Window::swap() {
  const auto before = std::chrono::steady_clock::now();
  glfwSwapBuffers(state_->window.get());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - before;
  if (state_->waits_for_monitor && spent.count() > kBlocked) {  // a hidden window, on some drivers
    state_->waits_for_monitor = false;
    glfwSwapInterval(0);
  }
}

std::vector<InputEvent> Window::poll(double wait_seconds) {
  if (wait_seconds > 0) {
    glfwWaitEventsTimeout(wait_seconds);
  } else {
    glfwPollEvents();
  }
  return std::exchange(state_->inbox.events, {});
}

void Window::wake() const { glfwPostEmptyEvent(); }

bool Window::should_close() const { return glfwWindowShouldClose(state_->window.get()) == GLFW_TRUE; }

void Window::set_should_close(bool close) {
  glfwSetWindowShouldClose(state_->window.get(), close ? GLFW_TRUE : GLFW_FALSE);
}

Extent Window::size() const {
  Extent points;
  glfwGetWindowSize(state_->window.get(), &points.width, &points.height);
  return points;
}

Extent Window::framebuffer_size() const {
  if (glfwGetWindowAttrib(state_->window.get(), GLFW_ICONIFIED) == GLFW_TRUE) return {};
  Extent pixels;
  glfwGetFramebufferSize(state_->window.get(), &pixels.width, &pixels.height);
  return pixels;
}

void Window::set_size(const Extent& size) {
  glfwSetWindowSize(state_->window.get(), size.width, size.height);
}

float Window::content_scale() const {
  float x = 1;
  float y = 1;
  glfwGetWindowContentScale(state_->window.get(), &x, &y);
  return x > 0 ? x : 1.0f;
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window.get(), title.c_str()); }

void Window::set_cursor(Cursor cursor) {
  if (cursor == state_->shown) return;
  state_->shown = cursor;
  const auto index = static_cast<std::size_t>(cursor);
  GLFWcursor*& made = state_->cursors[index];
  if (made == nullptr) made = glfwCreateStandardCursor(kShapes[index]);
  glfwSetCursor(state_->window.get(), made);
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(state_->window.get());
  return text == nullptr ? "" : text;
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(state_->window.get(), text.c_str());
}

bool Window::context_lost() const {
  return state_->reset_status != nullptr && state_->reset_status() != GL_NO_ERROR;
}

}  // namespace meander
