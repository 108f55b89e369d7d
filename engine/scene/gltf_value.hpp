#pragma once

#include "scene/gltf_source.hpp"
#include <cstddef>

namespace argand {

/// Member `key` of `object`; null if it is absent or `object` is not an object.
inline const nlohmann::json* find_member(const nlohmann::json* object, const char* key) {
    if (!object || !object->is_object()) {
        return nullptr;
    }
    const auto found = object->find(key);
    return found != object->end() ? &*found : nullptr;
}

/// Element `index` of the file's list `list` ("materials", "nodes", ...), or null.
inline const nlohmann::json* find_element(const GltfSource& source, const char* list,
                                          std::size_t index) {
    const nlohmann::json* elements = find_member(&source.root, list);
    return elements && elements->is_array() && index < elements->size() ? &(*elements)[index]
                                                                        : nullptr;
}

/// The object of extension `name` of `owner`, or null.
inline const nlohmann::json* find_extension(const nlohmann::json* owner, const char* name) {
    const nlohmann::json* extension = find_member(find_member(owner, "extensions"), name);
    return extension && extension->is_object() ? extension : nullptr;
}

/// The name of an object, or "".
inline std::string name_of(const nlohmann::json* object) {
    const nlohmann::json* name = find_member(object, "name");
    return name && name->is_string() ? name->get<std::string>() : "";
}

/// A number, or `otherwise` if it is absent. `what` names the object in messages.
inline double number_of(const GltfSource& source, const nlohmann::json* object, const char* key,
                        double otherwise, const std::string& what) {
    const nlohmann::json* value = find_member(object, key);
    if (!value) {
        return otherwise;
    }
    if (!value->is_number()) {
        source.fail("{} has a \"{}\" that is not a number", what, key);
    }
    return value->get<double>();
}

/// Three numbers, or `otherwise` if they are absent.
inline glm::dvec3 vector_of(const GltfSource& source, const nlohmann::json* object, const char* key,
                            const glm::dvec3& otherwise, const std::string& what) {
    const nlohmann::json* value = find_member(object, key);
    if (!value) {
        return otherwise;
    }
    const bool good = value->is_array() && value->size() == 3 && (*value)[0].is_number() &&
                      (*value)[1].is_number() && (*value)[2].is_number();
    if (!good) {
        source.fail("{} has a \"{}\" that is not three numbers", what, key);
    }
    return {(*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>()};
}

} // namespace argand
