#pragma once

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

struct MethodInfo;

/// The methods that a program offers, the default first. It views an array that must outlive it.
class MethodTable {
public:
    template <class Methods>
    explicit MethodTable(const Methods& methods)
        : first_(std::data(methods)), last_(first_ + std::size(methods)) {}

    const MethodInfo* begin() const { return first_; }
    const MethodInfo* end() const { return last_; }

    /// Null if no method has this name.
    const MethodInfo* find(std::string_view name) const;
    /// Throws UsageError, which lists the names, if no method has this one.
    const MethodInfo& at(std::string_view name) const;
    std::vector<std::string> names() const;

private:
    const MethodInfo* first_;
    const MethodInfo* last_;
};

/// Argand's own methods.
MethodTable builtin_methods();

/// Names of Argand's own methods, and of the first of them.
std::vector<std::string> method_names();
std::string default_method();

} // namespace argand
