#include "annotations.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <regex>
#include <sstream>

namespace argand::shader_compile {
namespace {

struct Annotation {
    std::string at; ///< "file:line: error: "
    std::string name;
    std::vector<std::string> arguments;
};

Annotation parse(const std::string& line, const std::string& at) {
    static const std::regex form(R"(\s*//@\s*(\w+)\(\s*(\w+(?:\s*,\s*\w+)*)\s*\)\s*)");
    std::smatch part;
    if (!std::regex_match(line, part, form)) {
        fail("{}an annotation is a line //@ name(argument, ...)", at);
    }
    Annotation annotation{at, part[1], {}};
    static const std::regex word(R"(\w+)");
    const std::string arguments = part[2];
    for (std::sregex_iterator i(arguments.begin(), arguments.end(), word), end; i != end; ++i) {
        annotation.arguments.push_back(i->str());
    }
    return annotation;
}

std::vector<Annotation> read_annotations(const Sources& sources) {
    std::vector<Annotation> annotations;
    for (const Source& source : sources) {
        std::istringstream lines(source.text);
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (line.find("//@") != std::string::npos) {
                annotations.push_back(
                    parse(line, fmt::format("{}:{}: error: ", source.path, number)));
            }
        }
    }
    return annotations;
}

/// Applies annotations to the bindings of one kernel.
class Annotator {
public:
    Annotator(const Sources& sources, const std::vector<std::string>& include_directories,
              Reflection& kernel)
        : sources_(sources), include_directories_(include_directories), kernel_(kernel) {}

    void apply(const Annotation& annotation) {
        if (annotation.name == "holds") {
            expect_arguments(annotation, "a buffer and a record", 2);
            holds(annotation, written(annotation, 0));
        } else if (annotation.name == "unordered") {
            expect_arguments(annotation, "a buffer, the words before its records and those of one",
                             3);
            Binding& binding = written(annotation, 0);
            binding.unordered_head = number(annotation, 1);
            binding.unordered_stride = number(annotation, 2);
        } else if (annotation.name == "incidental") {
            expect_arguments(annotation, "a buffer", 1);
            written(annotation, 0).incidental = true;
        } else if (annotation.name == "refers") {
            expect_arguments(annotation, "two buffers", 2);
            const Binding& target = written(annotation, 1);
            written(annotation, 0).refers_to = static_cast<int>(&target - kernel_.bindings.data());
        } else {
            fail("{}there is no annotation '{}'; those that are known are holds, unordered, "
                 "incidental and refers",
                 annotation.at, annotation.name);
        }
    }

private:
    static void expect_arguments(const Annotation& annotation, std::string_view what,
                                 std::size_t count) {
        if (annotation.arguments.size() != count) {
            fail("{}{} takes {}", annotation.at, annotation.name, what);
        }
    }

    Binding& written(const Annotation& annotation, std::size_t argument) {
        const std::string& name = annotation.arguments[argument];
        const auto found = std::find_if(kernel_.bindings.begin(), kernel_.bindings.end(),
                                        [&](const Binding& b) { return b.name == name; });
        if (found == kernel_.bindings.end()) {
            fail("{}{} names '{}', but the kernel declares no such buffer", annotation.at,
                 annotation.name, name);
        }
        if (found->access == Access::read) {
            fail("{}{} names '{}', which the kernel only reads", annotation.at, annotation.name,
                 name);
        }
        return *found;
    }

    /// The number, or the name of a constant that C++ sees too, as a C++ expression.
    std::string number(const Annotation& annotation, std::size_t argument) {
        const std::string& name = annotation.arguments[argument];
        if (name.find_first_not_of("0123456789") == std::string::npos) {
            return name;
        }
        for (const Source& source : sources_) {
            const std::string header = shared_path(source, include_directories_);
            if (!header.empty() &&
                line_of(without_comments(source.text), {"CONSTANT", "uint", name, "="})) {
                kernel_.constant_headers.push_back(header);
                return name;
            }
        }
        fail("{}{} names '{}', but no included header under shaders/shared/ declares such a "
             "CONSTANT uint",
             annotation.at, annotation.name, name);
    }

    /// What each word of a struct of a shared header is: 'f' a float, 'u' any other.
    std::string words_of(const Annotation& annotation, const std::string& record) const {
        const std::regex declaration("\\bstruct\\s+" + record + "\\s*\\{([^}]*)\\}");
        for (const Source& source : sources_) {
            const std::string text = without_comments(source.text);
            std::smatch body;
            if (shared_path(source, include_directories_).empty() ||
                !std::regex_search(text, body, declaration)) {
                continue;
            }
            std::string words;
            std::istringstream members(body[1]);
            static const std::regex member(R"(\s*(float32|uint)\s+(\w+(?:\s*,\s*\w+)*)\s*)");
            static const std::regex blank(R"(\s*)");
            for (std::string text_of_one; std::getline(members, text_of_one, ';');) {
                std::smatch part;
                if (std::regex_match(text_of_one, part, member)) {
                    const std::string names = part[2];
                    const auto commas = std::count(names.begin(), names.end(), ',');
                    words.append(1 + static_cast<std::size_t>(commas),
                                 part[1] == "uint" ? 'u' : 'f');
                } else if (!std::regex_match(text_of_one, blank)) {
                    fail("{}members of {} are not all float32 and uint", annotation.at, record);
                }
            }
            return words;
        }
        fail("{}{} names '{}', but no included header under shaders/shared/ declares such a struct",
             annotation.at, annotation.name, record);
    }

    void holds(const Annotation& annotation, Binding& binding) const {
        const std::string& record = annotation.arguments[1];
        const std::string words = words_of(annotation, record);
        const std::size_t element = binding.words.size();
        if (words.empty() || words.size() % element != 0) {
            fail("{}{} has {} words, but the elements of '{}' have {}", annotation.at, record,
                 words.size(), binding.name, element);
        }
        // If all elements of a record look alike, comparisons take each for an item.
        bool alike = true;
        for (std::size_t i = element; i < words.size(); ++i) {
            alike = alike && words[i] == words[i - element];
        }
        binding.words = alike ? words.substr(0, element) : words;
    }

    const Sources& sources_;
    const std::vector<std::string>& include_directories_;
    Reflection& kernel_;
};

} // namespace

void annotate(const Sources& sources, const std::vector<std::string>& include_directories,
              Reflection& kernel) {
    Annotator annotator(sources, include_directories, kernel);
    for (const Annotation& annotation : read_annotations(sources)) {
        annotator.apply(annotation);
    }
}

} // namespace argand::shader_compile
