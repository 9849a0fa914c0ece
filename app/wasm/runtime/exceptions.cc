// SPDX-License-Identifier: Apache-2.0
// C++ exceptions for a libc++abi that was built without them, as Debian's for WASI is. clang lowers
// `throw` to __cxa_throw, which throws WebAssembly's own exception, and each `catch` to a landing
// pad that asks _Unwind_CallPersonality which of its clauses fits what was caught.
// Source: Itanium C++ ABI, Exception Handling 2.4, 2.5 and its language-specific data area (7.2);
// LLVM, Exception Handling in WebAssembly.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <typeinfo>

namespace __cxxabiv1 {

// libc++abi's base of all type_info: whether a handler of this type takes what was thrown.
class __attribute__((visibility("hidden"))) __shim_type_info : public std::type_info {
 public:
  ~__shim_type_info() override;
  virtual void noop1() const;
  virtual void noop2() const;
  virtual bool can_catch(const __shim_type_info* thrown, void*& object) const = 0;
};

}  // namespace __cxxabiv1

namespace {

using TypeInfo = __cxxabiv1::__shim_type_info;

// Stands before the thrown object. WebAssembly's exception carries the address of `unwind`.
struct Thrown {
  std::type_info* type;
  void* (*destroy)(void*);
  int handlers;  // that are at work with it
  bool rethrown;
  Thrown* below;   // what was being handled when it was caught
  void* adjusted;  // the object as its handler sees it
  alignas(16) char unwind[32];
};

Thrown* being_handled = nullptr;

Thrown* BeforeObject(void* object) { return reinterpret_cast<Thrown*>(object) - 1; }
Thrown* Around(void* unwind) {
  return reinterpret_cast<Thrown*>(static_cast<char*>(unwind) - offsetof(Thrown, unwind));
}

std::uintptr_t Unsigned(const std::uint8_t*& at) {  // LEB128
  std::uintptr_t value = 0;
  for (unsigned shift = 0;; shift += 7) {
    const std::uint8_t byte = *at++;
    value |= std::uintptr_t(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
}
std::intptr_t Signed(const std::uint8_t*& at) {
  std::uintptr_t value = 0;
  unsigned shift = 0;
  std::uint8_t byte = 0;
  do {
    byte = *at++;
    value |= std::uintptr_t(byte & 0x7FU) << shift;
    shift += 7;
  } while ((byte & 0x80U) != 0);
  if ((byte & 0x40U) != 0 && shift < 8 * sizeof value) value |= ~std::uintptr_t(0) << shift;
  return static_cast<std::intptr_t>(value);
}

constexpr std::uint8_t kOmitted = 0xFF, kAbsolutePointer = 0;
constexpr int kContinueUnwind = 8, kHandlerFound = 6;

// The clause among a landing pad's actions that takes `thrown`; 0 = none, only things to destroy.
std::intptr_t MatchingClause(const std::uint8_t* action, const std::uint8_t* types,
                             Thrown* thrown) {
  for (;;) {
    const std::intptr_t clause = Signed(action);
    const std::uint8_t* const here = action;
    const std::intptr_t next = Signed(action);
    if (clause < 0) std::abort();  // an exception specification: C++20 has none
    if (clause > 0) {
      const TypeInfo* const caught = reinterpret_cast<const TypeInfo* const*>(types)[-clause];
      void* object = thrown + 1;
      const auto* const type = static_cast<const TypeInfo*>(thrown->type);
      if (caught == nullptr || caught->can_catch(type, object)) {
        thrown->adjusted = object;
        return clause;
      }
    }
    if (next == 0) return 0;
    action = here + next;
  }
}

}  // namespace

extern "C" {

// How a landing pad and the personality speak: index and data in, selector out.
struct LandingPad {
  std::uintptr_t index, data, selector;
};
LandingPad __wasm_lpad_context;

// Named by every function with handlers, called by none: _Unwind_CallPersonality does its work.
int __gxx_personality_wasm0(...) { return 0; }

void* __cxa_allocate_exception(std::size_t size) noexcept {
  auto* const thrown = static_cast<Thrown*>(std::calloc(1, sizeof(Thrown) + size));
  if (thrown == nullptr) std::abort();
  return thrown + 1;
}
void __cxa_free_exception(void* object) noexcept { std::free(BeforeObject(object)); }

// Destructors return their object in WebAssembly's C++ ABI.
[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void* (*destroy)(void*)) {
  Thrown* const thrown = BeforeObject(object);
  thrown->type = type;
  thrown->destroy = destroy;
  __builtin_wasm_throw(0, thrown->unwind);
}

int _Unwind_CallPersonality(void* unwind) {
  LandingPad& pad = __wasm_lpad_context;
  pad.selector = 0;
  if (pad.data == 0) return kContinueUnwind;
  const auto* at = reinterpret_cast<const std::uint8_t*>(pad.data);
  if (*at++ != kOmitted) std::abort();  // no base of landing pads: they are numbers
  const std::uint8_t types_as = *at++;
  const std::uint8_t* types = nullptr;
  if (types_as != kOmitted) {
    if (types_as != kAbsolutePointer) std::abort();
    const std::uintptr_t offset = Unsigned(at);
    types = at + offset;
  }
  ++at;  // how call sites are written: LEB128
  const std::uintptr_t size = Unsigned(at);
  const std::uint8_t* const actions = at + size;
  for (std::uintptr_t site = 0; at < actions; ++site) {
    Unsigned(at);  // the landing pad's number: its place in this table
    const std::uintptr_t action = Unsigned(at);
    if (site != pad.index) continue;
    if (action == 0) return kContinueUnwind;
    const std::intptr_t clause = MatchingClause(actions + action - 1, types, Around(unwind));
    pad.selector = static_cast<std::uintptr_t>(clause);
    return clause == 0 ? kContinueUnwind : kHandlerFound;
  }
  std::abort();
}

void* __cxa_get_exception_ptr(void* unwind) noexcept { return Around(unwind)->adjusted; }

void* __cxa_begin_catch(void* unwind) noexcept {
  Thrown* const thrown = Around(unwind);
  if (thrown->handlers == 0) {
    thrown->below = being_handled;
    being_handled = thrown;
  }
  ++thrown->handlers;
  thrown->rethrown = false;
  return thrown->adjusted;
}

void __cxa_end_catch() {
  Thrown* const thrown = being_handled;
  if (thrown == nullptr || --thrown->handlers > 0) return;
  being_handled = thrown->below;
  if (thrown->rethrown) return;
  if (thrown->destroy != nullptr) thrown->destroy(thrown + 1);
  std::free(thrown);
}

[[noreturn]] void __cxa_rethrow() {
  if (being_handled == nullptr) std::terminate();
  being_handled->rethrown = true;
  __builtin_wasm_throw(0, being_handled->unwind);
}

}  // extern "C"
