#include "gsv/formats/sdf/urdf_text.h"

#include "gsv/formats/sdf/urdf_repair.h"

namespace gsv::formats {

std::string UrdfText(const XmlFile& file, base::Problems& problems) {
  RepairUrdf(*file.root, file.path, problems);
  LineKeepingPrinter printer;
  printer.Text("<?xml version='1.0'?>");
  printer.Element(*file.root);
  return printer.Take();
}

}  // namespace gsv::formats
