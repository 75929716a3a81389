// The names that only a part of an expression knows: parameters of a function, an index of a sum.
#pragma once

#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace imp::syntax {

class Scope {
 public:
  // The newest name hides an older one of the same spelling.
  void push(std::string_view name) {
    const auto slot = static_cast<std::uint32_t>(bindings_.size());
    const auto [known, fresh] = slots_.try_emplace(name, slot);
    bindings_.push_back({name, fresh ? std::nullopt : std::optional(known->second)});
    known->second = slot;
  }

  void pop() {
    const auto [name, hidden] = bindings_.back();
    bindings_.pop_back();
    if (hidden)
      slots_[name] = *hidden;
    else
      slots_.erase(name);
  }

  void clear() {
    bindings_.clear();
    slots_.clear();
  }

  std::optional<std::uint32_t> find(std::string_view name) const {
    const auto found = slots_.find(name);
    return found == slots_.end() ? std::nullopt : std::optional(found->second);
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    names.reserve(bindings_.size());
    for (const Binding& binding : bindings_) names.push_back(binding.name);
    return names;
  }

 private:
  struct Binding {
    std::string_view name;
    std::optional<std::uint32_t> hidden;
  };
  std::vector<Binding> bindings_;
  std::unordered_map<std::string_view, std::uint32_t> slots_;
};

}  // namespace imp::syntax
