#pragma once

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

struct MethodInfo;
struct Option;

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
    /// The first unbiased method, which judges others in autotuning and makes the references of
    /// films; see reference_method(). Null if there is none.
    const MethodInfo* unbiased() const;
    /// The method that autotuning tries first. Null if there is none.
    const MethodInfo* tried_first() const;

    /// Every option that some method lists, once, in the order in which the methods list them.
    std::vector<const Option*> options() const;
    /// Names of the methods that list the option.
    std::vector<std::string> users_of(std::string_view option) const;

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
