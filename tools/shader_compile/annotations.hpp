#pragma once

#include "reflect.hpp"

namespace argand::shader_compile {

/// Adds to the bindings what a kernel's source says of them in annotations, which compare-backends
/// needs and SPIR-V cannot tell. An annotation is a line of its own, in the kernel or a file that
/// it includes:
///
/// - //@ holds(BUFFER, RECORD): the buffer is declared as words, but holds structs RECORD of a
///   shared header.
/// - //@ unordered(BUFFER, HEAD, STRIDE): behind HEAD words the buffer has records of STRIDE words,
///   in the order in which invocations happened to append them. HEAD and STRIDE are numbers or
///   uint constants of a shared header.
/// - //@ incidental(BUFFER): the contents depend on the order of the invocations, and later stages
///   do not.
/// - //@ refers(BUFFER, TARGET): the buffer has indices into TARGET, which depend on the order of
///   the invocations; the words to which they refer do not.
///
/// Throws Error "file:line: error: ..." for an annotation that is malformed, or that names
/// something that the kernel does not declare.
void annotate(const Sources& sources, const std::vector<std::string>& include_directories,
              Reflection& kernel);

} // namespace argand::shader_compile
