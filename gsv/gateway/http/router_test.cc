#include "gsv/gateway/http/router.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

Route Named(const char* method, const char* pattern, Permission permission = Permission::kWatch) {
  return {method, pattern,        permission,
          false,  Pool::kReaders, [](const Request&) { return Response(); }};
}

const Router& Routes() {
  static const Router kRouter({
      Named("GET", "/", Permission::kNone),
      Named("GET", "/{path...}", Permission::kNone),
      Named("GET", "/api/things"),
      Named("POST", "/api/things", Permission::kControl),
      Named("GET", "/api/things/{name}"),
      Named("GET", "/api/things/me"),
      Named("DELETE", "/api/things/{name}/parts/{part}", Permission::kControl),
      Named("GET", "/api/models/{id}.glb"),
      Named("PUT", "/files/{set}/{path...}", Permission::kControl),
      Named("PUT", "/files/{set}/lists/{list}", Permission::kControl),
  });
  return kRouter;
}

std::string PatternOf(const char* method, const char* target) {
  const Router::Match match = Routes().Find(method, ParseTarget(target).value());
  return match.route == nullptr ? "" : match.route->pattern;
}

TEST(Router, PrefersLiteralsThenParametersThenTheRest) {
  EXPECT_EQ(PatternOf("GET", "/"), "/");
  EXPECT_EQ(PatternOf("GET", "/index.html"), "/{path...}");
  EXPECT_EQ(PatternOf("GET", "/assets/a/b.js"), "/{path...}");
  EXPECT_EQ(PatternOf("GET", "/api/things/me"), "/api/things/me");
  EXPECT_EQ(PatternOf("GET", "/api/things/you?x=1"), "/api/things/{name}");
  EXPECT_EQ(PatternOf("GET", "/%61pi/things"), "/api/things");
  EXPECT_EQ(PatternOf("PUT", "/files/1/a/b"), "/files/{set}/{path...}");
  EXPECT_EQ(PatternOf("PUT", "/files/1/lists/a"), "/files/{set}/lists/{list}");
  EXPECT_EQ(PatternOf("PUT", "/files/1/lists"), "/files/{set}/{path...}");
  EXPECT_EQ(PatternOf("PUT", "/files/1/lists/a/b"), "/files/{set}/{path...}");
  // "/{path...}" does not match a path that begins like another route.
  EXPECT_EQ(PatternOf("GET", "/api/things/you/parts"), "");
}

TEST(Router, ReturnsTheParameters) {
  const auto parameters = [](const char* method, const char* target) {
    return Routes().Find(method, ParseTarget(target).value()).parameters;
  };
  using Parameters = std::map<std::string, std::string, std::less<>>;
  EXPECT_EQ(parameters("DELETE", "/api/things/a%2Fb/parts/c%20d"),
            (Parameters{{"name", "a/b"}, {"part", "c d"}}));
  EXPECT_EQ(parameters("GET", "/api/models/01.glb"), (Parameters{{"id", "01"}}));
  EXPECT_EQ(parameters("PUT", "/files/1/a/b"), (Parameters{{"set", "1"}}));
  EXPECT_EQ(parameters("PUT", "/files/1/lists/a/b"), (Parameters{{"set", "1"}}));
}

TEST(Router, AnswersRequestsWithoutARoute) {
  const auto answer = [](const char* method, const char* target) {
    return NoRoute(Routes().Find(method, ParseTarget(target).value()));
  };
  EXPECT_EQ(answer("PUT", "/api/things").status, 405);
  EXPECT_EQ(answer("PUT", "/api/things").allow, "GET, POST");
  EXPECT_EQ(answer("GET", "/files/1/a").allow, "PUT");
  EXPECT_EQ(answer("POST", "/index.html").allow, "GET");
  for (const char* target : {"/api", "/api/nothing", "/api/things/a/b", "/api/things/me/parts/c",
                             "/api/models/01", "/files", "/files/1"}) {
    EXPECT_EQ(answer("GET", target).status, 404) << target;
  }
}

TEST(Router, AMissingRouteNeedsTheLowestPermissionOfItsNeighbours) {
  const auto permission = [](const char* method, const char* target) {
    return Routes().Find(method, ParseTarget(target).value()).permission;
  };
  EXPECT_EQ(permission("POST", "/api/things"), Permission::kControl);
  EXPECT_EQ(permission("PUT", "/api/things"), Permission::kWatch);
  EXPECT_EQ(permission("GET", "/api/nothing"), Permission::kWatch);
  EXPECT_EQ(permission("GET", "/files/1"), Permission::kControl);
  EXPECT_EQ(permission("PUT", "/nothing"), Permission::kNone);
}

TEST(RouterDeathTest, RefusesRoutesThatContradictEachOther) {
  EXPECT_DEATH(Router({Named("GET", "/a"), Named("GET", "/a")}), "check failed");
  EXPECT_DEATH(Router({Named("GET", "/{a}"), Named("GET", "/{b}/c")}), "check failed");
  EXPECT_DEATH(Router({Named("GET", "/{a...}/b")}), "check failed");
  Route nameless = Named("POST", "/a");
  nameless.needs_control = true;
  EXPECT_DEATH(Router({nameless}), "check failed");
}

}  // namespace
}  // namespace gsv::gateway
