#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace argand {

/// The keys of a file's lights or cameras. Several nodes may carry one of them, so its keys are
/// kept once.
template <class Keys> class SharedKeys {
public:
    /// keys: of each object of the file.
    explicit SharedKeys(std::vector<Keys> keys) : keys_(std::move(keys)) {
        added_.resize(keys_.size(), -1);
    }

    /// Index of an object's keys in `kept`, to which they are added if they are new; -1: it rests.
    int add(std::size_t object, std::vector<Keys>& kept) {
        if (added_[object] < 0 && keys_[object].moves()) {
            added_[object] = static_cast<int>(kept.size());
            kept.push_back(std::move(keys_[object]));
        }
        return added_[object];
    }

private:
    std::vector<Keys> keys_;
    std::vector<int> added_;
};

} // namespace argand
