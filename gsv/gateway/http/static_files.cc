#include "gsv/gateway/http/static_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

namespace gsv::gateway {
namespace fs = std::filesystem;
namespace {

// Larger files are not served. The viewer's own files are far smaller.
constexpr std::uintmax_t kMaxFileBytes = 256u << 20;

constexpr auto kContentTypes = std::to_array<std::pair<std::string_view, std::string_view>>({
    {".css", "text/css; charset=utf-8"},
    {".glb", "model/gltf-binary"},
    {".html", "text/html; charset=utf-8"},
    {".ico", "image/vnd.microsoft.icon"},
    {".jpg", "image/jpeg"},
    {".js", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".png", "image/png"},
    {".svg", "image/svg+xml"},
    {".txt", "text/plain; charset=utf-8"},
    {".wasm", "application/wasm"},
    {".webmanifest", "application/manifest+json"},
    {".webp", "image/webp"},
    {".woff2", "font/woff2"},
});

bool IsPlainName(const std::string& segment) {
  return !segment.empty() && segment.front() != '.' &&
         segment.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

bool LiesUnder(const fs::path& file, const fs::path& root) {
  return std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
}

// Returns the path of a file below `root`; nullopt if there is no such file, or if it is outside
// `root`.
std::optional<fs::path> Resolve(const fs::path& root, const std::vector<std::string>& segments) {
  fs::path path = root;
  for (const std::string& segment : segments) {
    if (!IsPlainName(segment)) return std::nullopt;
    path /= segment;
  }
  if (segments.empty()) path /= "index.html";
  std::error_code error;
  fs::path file = fs::canonical(path, error);
  if (error || !LiesUnder(file, root)) return std::nullopt;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > kMaxFileBytes || error) {
    return std::nullopt;
  }
  return file;
}

std::string TagOf(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  const auto changed = fs::last_write_time(file, error).time_since_epoch().count();
  return '"' + std::to_string(size) + '-' + std::to_string(changed) + '"';
}

std::string Page(const std::string& body) {
  return "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>gsv</title>"
         "<body style=\"font:16px/1.5 sans-serif;max-width:40em;margin:4em auto\">" +
         body;
}

Response PageResponse(int status, const std::string& body) {
  Response response;
  response.status = status;
  response.content_type = "text/html; charset=utf-8";
  response.body = SharedBytes(Page(body));
  return response;
}

std::string EscapedHtml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::string_view ContentTypeOf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* found = std::find_if(kContentTypes.begin(), kContentTypes.end(),
                                   [&](const auto& entry) { return entry.first == extension; });
  return found == kContentTypes.end() ? "application/octet-stream" : found->second;
}

StaticFiles::StaticFiles(const fs::path& root) : given_(root) {
  std::error_code error;
  if (!root.empty() && fs::is_directory(root, error)) root_ = fs::canonical(root, error);
}

std::optional<Response> StaticFiles::Find(const std::vector<std::string>& segments,
                                          const std::string& if_none_match) const {
  const std::optional<fs::path> file = root_.empty() ? std::nullopt : Resolve(root_, segments);
  if (!file) return std::nullopt;
  Response response;
  response.content_type = ContentTypeOf(*file);
  response.etag = TagOf(*file);
  response.cache_control = "no-cache";
  if (Matches(if_none_match, response.etag)) {
    response.status = 304;
    return response;
  }
  std::ifstream in(*file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) return ErrorResponse(500, "cannot read the file");
  response.body = SharedBytes(std::move(bytes));
  return response;
}

Response StaticFiles::Get(const Request& request) const {
  const std::vector<std::string>& segments = request.target.segments;
  std::optional<Response> found = Find(segments, request.if_none_match);
  if (!found) {
    return segments.empty() ? Explain()
                            : ErrorResponse(404, "there is no resource at this address");
  }
  // Pages of other sites load this file to show the view (docs/viewer.md).
  found->allows_other_sites = segments == std::vector<std::string>{"gsv-view.js"};
  // The names of files under assets/ change with their content, so browsers may cache them forever.
  if (found->status < 400 && !segments.empty() && segments.front() == "assets") {
    found->cache_control = "public, max-age=31536000, immutable";
  }
  return *std::move(found);
}

std::vector<Route> StaticFiles::Routes() const {
  const Route::Handler get = [this](const Request& request) { return Get(request); };
  return {{"GET", "/", Permission::kNone, false, Pool::kReaders, get, "The viewer"},
          {"GET", "/{path...}", Permission::kNone, false, Pool::kReaders, get,
           "Get a file of the viewer"}};
}

Response StaticFiles::Explain() const {
  const std::string place = given_.empty()
                                ? "no directory was given for it"
                                : "there is no index.html in " + EscapedHtml(given_.string());
  return PageResponse(
      404,
      "<h1>The viewer is not installed</h1><p>gsv is running, but its viewer cannot be shown: " +
          place +
          ". Build it with <code>npm ci &amp;&amp; npm run build</code> in <code>web/</code>, then "
          "load "
          "this page again.</p><p>The simulations can be reached without it: "
          "<a href=\"/api/simulations\">/api/simulations</a>.</p>");
}

Response Documentation::Get(const Request& request) const {
  const std::vector<std::string>& all = request.target.segments;
  const std::vector<std::string> segments(all.begin() + 1, all.end());
  const std::string_view path =
      std::string_view(request.raw_target).substr(0, request.raw_target.find('?'));
  if (segments.empty() && !path.ends_with('/')) {
    // Redirects to the address with a slash, because links in the pages are relative to "/docs/".
    return PageResponse(200, "<meta http-equiv=\"refresh\" content=\"0; url=docs/\">");
  }
  if (std::optional<Response> found = files_.Find(segments, request.if_none_match)) {
    found->allows_own_frames = true;  // doxygen's pages show search results in a frame
    return *std::move(found);
  }
  if (!segments.empty()) return ErrorResponse(404, "the documentation has no page of this name");
  return PageResponse(404,
                      "<h1>The documentation is not installed</h1><p>Build it with <code>make "
                      "docs</code> in the source tree, then load this page again. The pages are "
                      "the files in the folder <code>docs</code> of the source tree.</p>");
}

std::vector<Route> Documentation::Routes() const {
  const Route::Handler get = [this](const Request& request) { return Get(request); };
  return {{"GET", "/docs", Permission::kNone, false, Pool::kReaders, get, "The documentation"},
          {"GET", "/docs/{path...}", Permission::kNone, false, Pool::kReaders, get,
           "Get a file of the documentation"}};
}

}  // namespace gsv::gateway
