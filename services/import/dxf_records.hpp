// Reads a DXF text file as records: pairs of group code and value, from one code 0 to the next,
// without interpretation.
#pragma once

#include <string_view>
#include <vector>

#include "services/import/drawing.hpp"

namespace breach::importing {

struct Group {
    int code;
    std::string_view value;
    std::size_t line;  ///< of the value, from 1
};

struct Record {
    std::string_view type;  ///< "SECTION", "LWPOLYLINE"
    std::size_t line;
    std::vector<Group> groups;
};

/// Reads record by record; the text must outlive this object.
class Records {
  public:
    explicit Records(std::string_view text);
    /// False at the end of the file or at a fault (faults()).
    bool next(Record& record);
    const std::vector<Fault>& faults() const { return faults_; }

  private:
    bool read(Group& group);
    bool stop(std::size_t line, std::string cause, std::string remedy);

    std::string_view rest_;
    std::size_t line_ = 0;
    Group ahead_{};
    bool has_ahead_ = false;
    bool ended_ = false;
    std::vector<Fault> faults_;
};

/// Why these bytes are not DXF text (binary form, DWG, NUL bytes); empty: they may be.
std::vector<Fault> form_faults(std::string_view bytes);

}  // namespace breach::importing
