#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace argand::testing {

/// An element of an XML document.
struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::vector<XmlElement> children;
    std::string text; ///< of the element itself, without its children's

    double number(const std::string& attribute) const {
        return std::stod(attributes.at(attribute));
    }

    /// All elements of this name below this one, in document order.
    std::vector<XmlElement> all(std::string_view wanted) const {
        std::vector<XmlElement> found;
        for (const XmlElement& child : children) {
            if (child.name == wanted) {
                found.push_back(child);
            }
            const std::vector<XmlElement> below = child.all(wanted);
            found.insert(found.end(), below.begin(), below.end());
        }
        return found;
    }
};

/// Parses the subset of XML that an SVG plot uses: elements, quoted attributes, text and the four
/// named entities. Throws std::runtime_error if the text is not well-formed.
class XmlParser {
public:
    static XmlElement parse(std::string_view text) {
        XmlParser parser(text);
        parser.skip_space();
        XmlElement root = parser.element();
        parser.skip_space();
        parser.require(parser.at_ == text.size(), "one root element");
        return root;
    }

private:
    explicit XmlParser(std::string_view text) : text_(text) {}

    void require(bool holds, const std::string& what) const {
        if (!holds) {
            throw std::runtime_error("XML: expected " + what + " at " + std::to_string(at_));
        }
    }

    char peek() const {
        require(at_ < text_.size(), "more text");
        return text_[at_];
    }

    bool skip(std::string_view token) {
        const bool found = text_.substr(at_).starts_with(token);
        at_ += found ? token.size() : 0;
        return found;
    }

    void skip_space() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
            ++at_;
        }
    }

    std::string name() {
        std::string result;
        while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '-' || peek() == ':') {
            result += text_[at_++];
        }
        require(!result.empty(), "a name");
        return result;
    }

    /// Text up to an unescaped `end`, decoded.
    std::string text_until(char end) {
        static const std::map<std::string, char> entities = {
            {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}};
        std::string result;
        while (peek() != end) {
            const char c = text_[at_++];
            require(c != '<', "no bare '<'");
            require(static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t',
                    "no control character");
            if (c != '&') {
                result += c;
                continue;
            }
            const std::string entity = name();
            require(entities.contains(entity) && skip(";"), "a known entity");
            result += entities.at(entity);
        }
        return result;
    }

    XmlElement element() {
        require(skip("<"), "an element");
        XmlElement result{.name = name(), .attributes = {}, .children = {}, .text = ""};
        for (skip_space(); peek() != '>' && peek() != '/'; skip_space()) {
            const std::string attribute = name();
            require(skip("=\""), "a quoted value");
            require(result.attributes.emplace(attribute, text_until('"')).second,
                    "each attribute once");
            skip("\"");
        }
        if (skip("/>")) {
            return result;
        }
        require(skip(">"), "the end of the tag");
        for (;;) {
            result.text += text_until('<');
            if (skip("</" + result.name + ">")) {
                return result;
            }
            result.children.push_back(element());
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace argand::testing
