#include "runner/store/schema_text.h"

#include "runner/store/catalogue_sql.h"
#include "runner/store/result_file_md.h"

namespace seapile::store {

// The texts begin behind the line break that follows their delimiter.
std::string result_file_text() { return kResultFileMd + 1; }

std::string catalogue_text() { return kCatalogueSql + 1; }

}  // namespace seapile::store
