// The schema of SDFormat in libsdformat: a description of each element.
#pragma once

#include <set>
#include <string>

#include <sdf/Element.hh>

namespace gsv::formats {

// The description of <sdf>, with those of all elements below it: the same tree as sdf::init()
// builds. Elements that several elements have in common, such as <sensor>, are one object here, so
// this takes a fifth of the time. Elements named in `without` have no description. Null if
// libsdformat has no schema. Read only.
//
// Threads  one at a time, as for all of libsdformat.
sdf::ElementPtr MakeSdfSchema(const std::set<std::string>& without = {});

// The description in a file of the schema, such as "model.sdf", with those of all elements below
// it. "root.sdf" is that of <sdf>. It is made once. Null if there is no such file.
sdf::ElementPtr DescriptionInFile(const std::string& file);

}  // namespace gsv::formats
