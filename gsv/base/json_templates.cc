#include "gsv/base/json_templates.h"

GSV_JSON_TEMPLATES(template)
