// Text of any encoding as UTF-8.
#pragma once

#include <string>
#include <vector>

namespace hbr::inline robots {

// The contents of an XML file in UTF-8, without a byte-order mark: converted from what the mark, the pattern
// of its first bytes or its declaration says (by iconv). What is not in the encoding that it should be in is
// read as ISO-8859-1, and `odd` gets a line that says so. Throws InputError, with the file's name `path`,
// where UTF-16 or UTF-32 breaks off or an encoding is unknown here.
std::string utf8_of_xml(const std::string& path, const std::string& bytes, std::vector<std::string>& odd);

}  // namespace hbr::inline robots
