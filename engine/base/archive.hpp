#pragma once

#include "base/error.hpp"

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace argand {

/// Saves values to bytes, or loads them from there. One function that names the values in order
/// serves both, so that what is loaded is what was saved. The bytes are those of this machine.
class Archive {
public:
    /// Saves.
    Archive() = default;
    /// Loads. The bytes must outlive the archive.
    explicit Archive(std::span<const std::uint8_t> from) : from_(from), loads_(true) {}

    bool loads() const { return loads_; }

    /// Loading throws Error if the bytes end before the value does. Any bytes must be a value.
    template <class T> void value(T& value) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>);
        if (loads_) {
            std::memcpy(&value, take(sizeof(T)), sizeof(T));
        } else {
            add(&value, sizeof(T));
        }
    }

    template <class T> void values(std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::uint64_t count = values.size();
        value(count);
        if (loads_) {
            check_room(count, sizeof(T));
            values.resize(count);
            if (count > 0) {
                std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
            }
        } else {
            add(values.data(), count * sizeof(T));
        }
    }

    /// A bool must not be loaded as bytes: it has other values than 0 and 1.
    void flag(bool& flag) {
        std::uint8_t byte = flag ? 1 : 0;
        value(byte);
        flag = byte != 0;
    }

    template <class T> void optional(std::optional<T>& optional) {
        bool has_value = optional.has_value();
        flag(has_value);
        T contents = optional.value_or(T());
        value(contents);
        optional = has_value ? std::optional<T>(contents) : std::nullopt;
    }

    void text(std::string& text) {
        std::vector<char> characters(text.begin(), text.end());
        values(characters);
        text.assign(characters.begin(), characters.end());
    }

    /// What was saved.
    std::vector<std::uint8_t> take_bytes() && { return std::move(saved_); }
    /// Whether all was loaded.
    bool at_end() const { return from_.empty(); }

private:
    void add(const void* bytes, std::size_t count) {
        const auto* first = static_cast<const std::uint8_t*>(bytes);
        saved_.insert(saved_.end(), first, first + count);
    }
    const std::uint8_t* take(std::size_t count) {
        check_room(count, 1);
        const std::uint8_t* first = from_.data();
        from_ = from_.subspan(count);
        return first;
    }
    void check_room(std::uint64_t count, std::size_t each) const {
        if (count > from_.size() / each) {
            fail("loading a saved state: it ends too early");
        }
    }

    std::vector<std::uint8_t> saved_;
    std::span<const std::uint8_t> from_;
    bool loads_ = false;
};

} // namespace argand
