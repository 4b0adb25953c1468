#include "gsv/broker/offers/query_compilation.h"

#include <optional>
#include <string_view>
#include <utility>

#include "gsv/broker/language/type_check.h"

namespace gsv::broker {
namespace {

DeclaredTypes TypesOf(const ServiceType& type) {
  return [&type](std::string_view name) -> std::optional<PropertyType> {
    for (const PropertyDefinition& definition : type.properties) {
      if (definition.name == name) return definition.type;
    }
    return std::nullopt;
  };
}

}  // namespace

TradingResult<Expression> CompileConstraint(const std::string& text, const ServiceType& type,
                                            const ExpressionLimits& limits) {
  const auto refuse = [&](const base::Error& error) {
    return Refuse(
        {.refusal = Refusal::kIllegalConstraint, .name = text, .detail = error.Sentence()});
  };
  auto constraint = ParseConstraint(text, limits);
  if (!constraint) return refuse(constraint.error());
  const base::Status fits = CheckConstraintTypes(*constraint, TypesOf(type));
  if (!fits) return refuse(fits.error());
  return std::move(*constraint);
}

TradingResult<Preference> CompilePreference(const std::string& text, const ServiceType& type,
                                            const ExpressionLimits& limits) {
  const auto refuse = [&](const base::Error& error) {
    return Refuse(
        {.refusal = Refusal::kIllegalPreference, .name = text, .detail = error.Sentence()});
  };
  auto preference = ParsePreference(text, limits);
  if (!preference) return refuse(preference.error());
  const base::Status fits = CheckPreferenceTypes(*preference, TypesOf(type));
  if (!fits) return refuse(fits.error());
  return std::move(*preference);
}

}  // namespace gsv::broker
