#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

namespace argand {

/// The members of a JSON object that a user wrote. What nobody asks for is an error, so that a
/// misspelt member does not pass in silence.
class JsonMembers {
public:
    /// doing: of messages, such as "reading edits 'room.json'". where: of the object in the text.
    /// Keeps a reference to the object. Throws Error if it is none.
    JsonMembers(const nlohmann::json& object, std::string where, std::string doing);

    /// The member of that name; null: there is none.
    const nlohmann::json* find(const char* key);

    /// Throws Error, which says that the member is not what is expected.
    [[noreturn]] void complain(const char* key, std::string_view expected) const;

    /// Call after all members have been asked for. Throws Error if there are others.
    void end() const;

    const std::string& doing() const { return doing_; }

private:
    const nlohmann::json& object_;
    std::string where_, doing_;
    std::set<std::string> known_;
};

} // namespace argand
