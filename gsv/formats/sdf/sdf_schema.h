// Builds libsdformat's schema of SDFormat: a description of each element.
#pragma once

#include <set>
#include <string>

#include <sdf/Element.hh>

namespace gsv::formats {

// Returns the description of <sdf>, with the descriptions of all elements below it. This is the
// same tree as sdf::init() builds. Elements that several elements have in common, such as <sensor>,
// are one object here. So this function takes a fifth of the time of sdf::init(). Elements named in
// `without` have no description. Returns null if libsdformat has no schema. The result must not be
// changed.
//
// Threads  one at a time, as for all of libsdformat.
sdf::ElementPtr MakeSdfSchema(const std::set<std::string>& without = {});

// Returns the description in a file of the schema, such as "model.sdf" ("root.sdf" for <sdf>), with
// the descriptions of all elements below it. The description is built once. Returns null if there
// is no such file.
sdf::ElementPtr DescriptionInFile(const std::string& file);

}  // namespace gsv::formats
