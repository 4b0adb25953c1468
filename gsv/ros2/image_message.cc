#include "gsv/ros2/image_message.h"

#include "gsv/messages/std_msgs.h"
#include "gsv/messages/time.h"

namespace gsv::ros2 {
namespace {

struct Pixels {
  int width = 0, height = 0;
  const char* encoding = "";
  int bytes = 0;  // bytes per pixel
};

// Writes all fields that precede the pixels.
void WriteHead(const Pixels& pixels, base::SimTime time, const std::string& frame,
               messages::CdrWriter& writer) {
  messages::std_msgs::Header header;
  header.stamp = messages::ToMessage(time);
  header.frame_id = frame;
  Encode(header, writer);
  writer.Write(static_cast<std::uint32_t>(pixels.height));
  writer.Write(static_cast<std::uint32_t>(pixels.width));
  writer.Write(std::string_view(pixels.encoding));
  writer.Write(std::uint8_t{0});  // is_bigendian: 0 means no
  writer.Write(static_cast<std::uint32_t>(pixels.width * pixels.bytes));
  writer.WriteCount(static_cast<std::size_t>(pixels.width) * pixels.height * pixels.bytes);
}

}  // namespace

void EncodeImageHead(const model::Image& image, base::SimTime time, const std::string& frame,
                     messages::Bytes& out) {
  const bool has_alpha = image.channels == 4;
  messages::CdrWriter writer(out);
  WriteHead({image.width, image.height, has_alpha ? "rgba8" : "rgb8", image.channels}, time, frame,
            writer);
}

void EncodeDepth(int width, int height, std::span<const double> depth, base::SimTime time,
                 const std::string& frame, messages::Bytes& out) {
  std::vector<float> metres(depth.begin(), depth.end());
  messages::CdrWriter writer(out);
  WriteHead({width, height, "32FC1", sizeof(float)}, time, frame, writer);
  // In the message, `data` is a sequence of bytes. Therefore, the alignment is 1 and not that of
  // float.
  writer.WriteBlock(metres.data(), metres.size() * sizeof(float), 1);
}

}  // namespace gsv::ros2
