#include "ui/interface.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <deque>

#include "ui/style.h"

namespace meander {

struct Interface::State {
  ImGuiContext* context = nullptr;
  std::deque<InputEvent> events;
  float scale = 1;
  bool font_changed = true;
  ClipboardAccess clipboard;
  std::string clipboard_text;  // kept for ImGui, which takes a pointer
};

namespace {

constexpr float kOutside = -1e6f;

void map_keys(ImGuiIO& io) {
  struct Pair {
    ImGuiKey_ key;
    int code;
  };
  constexpr std::array kPairs{
      Pair{ImGuiKey_Tab, key::kTab},
      Pair{ImGuiKey_LeftArrow, key::kLeft},
      Pair{ImGuiKey_RightArrow, key::kRight},
      Pair{ImGuiKey_UpArrow, key::kUp},
      Pair{ImGuiKey_DownArrow, key::kDown},
      Pair{ImGuiKey_PageUp, key::kPageUp},
      Pair{ImGuiKey_PageDown, key::kPageDown},
      Pair{ImGuiKey_Home, key::kHome},
      Pair{ImGuiKey_End, key::kEnd},
      Pair{ImGuiKey_Insert, key::kInsert},
      Pair{ImGuiKey_Delete, key::kDelete},
      Pair{ImGuiKey_Backspace, key::kBackspace},
      Pair{ImGuiKey_Space, key::kSpace},
      Pair{ImGuiKey_Enter, key::kEnter},
      Pair{ImGuiKey_Escape, key::kEscape},
      Pair{ImGuiKey_KeyPadEnter, key::kKeypadEnter},
      Pair{ImGuiKey_A, 'A'},
      Pair{ImGuiKey_C, 'C'},
      Pair{ImGuiKey_V, 'V'},
      Pair{ImGuiKey_X, 'X'},
      Pair{ImGuiKey_Y, 'Y'},
      Pair{ImGuiKey_Z, 'Z'},
  };
  for (const Pair& pair : kPairs) io.KeyMap[pair.key] = pair.code;
}

void release_everything(ImGuiIO& io) {
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  io.KeyCtrl = io.KeyShift = io.KeyAlt = io.KeySuper = false;
}

void set_modifiers(ImGuiIO& io, const Modifiers& modifiers) {
  io.KeyCtrl = modifiers.control;
  io.KeyShift = modifiers.shift;
  io.KeyAlt = modifiers.alt;
  io.KeySuper = modifiers.super;
}

// Of a modifier's own key the state before the event is told, at least under X.
void set_modifier_key(ImGuiIO& io, const InputEvent& event) {
  if (event.code == key::kLeftControl || event.code == key::kRightControl) io.KeyCtrl = event.down;
  if (event.code == key::kLeftShift || event.code == key::kRightShift) io.KeyShift = event.down;
  if (event.code == key::kLeftAlt || event.code == key::kRightAlt) io.KeyAlt = event.down;
  if (event.code == key::kLeftSuper || event.code == key::kRightSuper) io.KeySuper = event.down;
}

// What has changed in a frame so far.
struct Changed {
  std::array<bool, 3> buttons{};
  std::array<bool, 512> keys{};
  bool any_button = false;
  bool moved = false;
};

bool in_range(const InputEvent& event, std::size_t size) {
  return event.code >= 0 && static_cast<std::size_t>(event.code) < size;
}

// Whether the event has to wait for the next frame: ImGui 1.86 knows states, not what happened in between. A
// release waits for the move before it, which is the end of a drag, and what is typed for the click before
// it, which may be into a field.
bool must_wait(const InputEvent& event, const Changed& changed) {
  const bool typed = event.kind == InputKind::key || event.kind == InputKind::text;
  if (typed && changed.any_button) return true;
  if (event.kind == InputKind::button)
    return in_range(event, changed.buttons.size()) &&
           (changed.buttons[static_cast<std::size_t>(event.code)] || (!event.down && changed.moved));
  if (event.kind == InputKind::key)
    return in_range(event, changed.keys.size()) && changed.keys[static_cast<std::size_t>(event.code)];
  return event.kind == InputKind::move && changed.any_button;
}

void move_pointer(ImGuiIO& io, const InputEvent& event, float pointer_scale) {
  io.MousePos = {static_cast<float>(event.x) * pointer_scale, static_cast<float>(event.y) * pointer_scale};
}

void apply_event(ImGuiIO& io, const InputEvent& event, float pointer_scale, Changed& changed) {
  switch (event.kind) {
    case InputKind::move:
      move_pointer(io, event, pointer_scale);
      set_modifiers(io, event.modifiers);
      changed.moved = true;
      break;
    case InputKind::leave:
      if (!ImGui::IsAnyMouseDown()) io.MousePos = {kOutside, kOutside};
      break;
    case InputKind::button:
      if (!in_range(event, changed.buttons.size())) break;
      move_pointer(io, event, pointer_scale);
      set_modifiers(io, event.modifiers);
      io.MouseDown[event.code] = event.down;
      changed.buttons[static_cast<std::size_t>(event.code)] = changed.any_button = true;
      break;
    case InputKind::scroll:
      io.MouseWheelH += static_cast<float>(event.x);
      io.MouseWheel += static_cast<float>(event.y);
      break;
    case InputKind::key:
      if (!in_range(event, changed.keys.size())) break;
      set_modifiers(io, event.modifiers);
      set_modifier_key(io, event);
      changed.keys[static_cast<std::size_t>(event.code)] = io.KeysDown[event.code] != event.down;
      io.KeysDown[event.code] = event.down;
      break;
    case InputKind::text:
      io.AddInputCharacter(static_cast<unsigned>(event.character));
      break;
    case InputKind::focus:
      if (!event.down) release_everything(io);
      break;
    case InputKind::drop:
    case InputKind::redraw:
      break;
  }
}

}  // namespace

Interface::Interface(float scale) : state_(std::make_unique<State>()) {
  state_->context = ImGui::CreateContext();
  ImGui::SetCurrentContext(state_->context);
  try {
    load_fonts(scale);
  } catch (...) {
    ImGui::DestroyContext(state_->context);
    throw;
  }
  state_->scale = scale;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendPlatformName = "meander";
  io.BackendRendererName = "meander";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.MousePos = {kOutside, kOutside};
  io.ClipboardUserData = state_.get();
  io.GetClipboardTextFn = [](void* data) {
    State& state = *static_cast<State*>(data);
    if (state.clipboard.get) state.clipboard_text = state.clipboard.get();
    return state.clipboard_text.c_str();
  };
  io.SetClipboardTextFn = [](void* data, const char* text) {
    State& state = *static_cast<State*>(data);
    state.clipboard_text = text;
    if (state.clipboard.set) state.clipboard.set(text);
  };
  map_keys(io);
  apply_style();
}

Interface::~Interface() { ImGui::DestroyContext(state_->context); }

FontBitmap Interface::font() const {
  ImGui::SetCurrentContext(state_->context);
  FontBitmap bitmap;
  unsigned char* pixels = nullptr;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &bitmap.width, &bitmap.height);
  bitmap.coverage = pixels;
  return bitmap;
}

bool Interface::font_changed() const { return state_->font_changed; }

void Interface::set_font_texture(void* texture) {
  ImGui::SetCurrentContext(state_->context);
  ImGui::GetIO().Fonts->SetTexID(texture);
  state_->font_changed = false;
}

void Interface::set_clipboard(ClipboardAccess clipboard) { state_->clipboard = std::move(clipboard); }

void Interface::feed(const InputEvent& event) { state_->events.push_back(event); }

bool Interface::pending() const { return !state_->events.empty(); }

void Interface::begin_frame(const FrameShape& shape) {
  assert(shape.pixels_wide > 0 && shape.pixels_high > 0 && shape.scale > 0);
  ImGui::SetCurrentContext(state_->context);
  if (shape.scale != state_->scale) {
    load_fonts(shape.scale);
    state_->scale = shape.scale;
    state_->font_changed = true;
  }
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {shape.width(), shape.height()};
  io.DisplayFramebufferScale = {shape.scale, shape.scale};
  io.DeltaTime = static_cast<float>(std::clamp(shape.seconds, 1e-4, 1.0));
  Changed changed;
  while (!state_->events.empty() && !must_wait(state_->events.front(), changed)) {
    apply_event(io, state_->events.front(), shape.pointer_scale, changed);
    state_->events.pop_front();
  }
  ImGui::NewFrame();
}

const ImDrawData* Interface::end_frame() {
  ImGui::SetCurrentContext(state_->context);
  ImGui::Render();
  return ImGui::GetDrawData();
}

bool Interface::wants_mouse(float x, float y) const {
  const ImGuiContext& context = *state_->context;
  if (context.OpenPopupStack.Size > 0) return true;
  for (int button = 0; button < IM_ARRAYSIZE(context.IO.MouseDown); ++button)
    if (context.IO.MouseDown[button] && context.IO.MouseDownOwned[button]) return true;
  return std::any_of(context.Windows.begin(), context.Windows.end(), [x, y](const ImGuiWindow* window) {
    return window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
           window->OuterRectClipped.Contains({x, y});
  });
}

bool Interface::wants_keyboard() const {
  ImGui::SetCurrentContext(state_->context);
  return state_->context->WantTextInputNextFrame > 0 ||
         ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

PointerShape Interface::pointer_shape() const {
  ImGui::SetCurrentContext(state_->context);
  switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
      return PointerShape::text;
    case ImGuiMouseCursor_Hand:
      return PointerShape::hand;
    case ImGuiMouseCursor_ResizeEW:
      return PointerShape::horizontal;
    case ImGuiMouseCursor_ResizeNS:
      return PointerShape::vertical;
    case ImGuiMouseCursor_ResizeAll:
      return PointerShape::crosshair;
    default:
      return PointerShape::arrow;
  }
}

}  // namespace meander
