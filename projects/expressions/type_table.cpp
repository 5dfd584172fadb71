#include "projects/expressions/type_table.hpp"

#include "projects/literals/types.hpp"
#include "scheduler/expression.hpp"

namespace lockstep {
namespace {

using enum Type;

constexpr TypeText kTypes[] = {
    {BOOL, "FALSE or TRUE", {"BOOL#1", BOOL, "TRUE"}},
    {SINT, "integer of 8 bits", {"SINT#-128", SINT, "-128"}},
    {INT, "integer of 16 bits", {"INT#16#7FFF", INT, "32767"}},
    {DINT,
     "integer of 32 bits; of an integer literal whose place asks for none",
     {"DINT#-2_147_483_648", DINT, "-2147483648"}},
    {LINT, "integer of 64 bits", {"LINT#9223372036854775807", LINT, "9223372036854775807"}},
    {USINT, "integer of 8 bits without sign", {"USINT#255", USINT, "255"}},
    {UINT, "integer of 16 bits without sign", {"UINT#65535", UINT, "65535"}},
    {UDINT, "integer of 32 bits without sign", {"UDINT#4294967295", UDINT, "4294967295"}},
    {ULINT, "integer of 64 bits without sign", {"ULINT#18446744073709551615", ULINT, "18446744073709551615"}},
    {BYTE, "8 bits, .X0 to .X7", {"BYTE#16#A5", BYTE, "165"}},
    {WORD, "16 bits, .X0 to .X15", {"WORD#16#1234", WORD, "16#1234"}},
    {DWORD, "32 bits, .X0 to .X31", {"DWORD#2#1", DWORD, "1"}},
    {LWORD, "64 bits, .X0 to .X63", {"LWORD#16#FFFF_FFFF_FFFF_FFFF", LWORD, "16#FFFFFFFFFFFFFFFF"}},
    {REAL,
     "floating point of 32 bits (IEC 60559); each operation is rounded to it",
     {"REAL#0.1", REAL, "0.1"}},
    {LREAL,
     "floating point of 64 bits (IEC 60559); of a real literal whose place asks for none",
     {"LREAL#1.5E3", LREAL, "1500.0"}},
    {TIME,
     R"(duration, a whole number of nanoseconds; T#10ms in an expression, and so at a pin; of "init", stimuli and "cycle" also "10ms")",
     {"T#1s500ms", TIME, "TIME#1.5s"}}};

constexpr OtherType kOthers[] = {
    {"STRING[n]",
     "text of up to n printable characters of ISO 8859-1, n from 1 to 254; it is compared with = and <>, "
     "chosen by SEL and MUX, and assigned, nothing else"},
    {"ARRAY[lower..upper] OF type",
     "elements of an elementary type or of TO_Cam_Struct_PointData, TO_Cam_Struct_SegmentData; bounds of "
     "DINT, up to 100,000 elements"},
    {"AXIS", "pin that takes a technology object by its name"},
    {"ARRAY", "pin that takes an array by the name of its tag"},
    {"DB_ANY", "number of a technology object, a UDINT in expressions; lockstep tags lists them"}};

constexpr LiteralForm kForms[] = {
    {"TRUE, FALSE", "BOOL", {"TRUE", BOOL, "BOOL#1"}},
    {"3, -3, 1_000", "integer of any type that holds it", {"1_000", INT, "1000"}},
    {"2#…, 8#…, 16#…", "integer or bits in base 2, 8 or 16", {"2#1010", BYTE, "16#0A"}},
    {"1.5, 1.5E3, 2E-3", "REAL or LREAL; the digit behind the point is needed", {"1.5E3", LREAL, "1500.0"}},
    {"type#value", "value of that type", {"INT#16#FF", INT, "255"}},
    {"T#…, TIME#…",
     "duration of d, h, m, s, ms, us, ns in this order, the last one with decimals if need be",
     {"T#1h_2.5m", TIME, "T#3750s"}},
    {"'text'", "text; $' is an apostrophe, $$ a dollar sign", {"'it$'s' = 'it$27s'", BOOL, "TRUE"}}};

}  // namespace

std::span<const TypeText> elementary_types() noexcept {
  return kTypes;
}

std::span<const OtherType> other_types() noexcept {
  return kOthers;
}

std::span<const LiteralForm> literal_forms() noexcept {
  return kForms;
}

std::string range_of_type(Type type) {
  switch (type) {
    case Type::BOOL:
      return "FALSE, TRUE";
    case Type::REAL:
      return "-3.4028235E38 to 3.4028235E38, infinity, NaN";
    case Type::LREAL:
      return "-1.7976931348623157E308 to 1.7976931348623157E308, infinity, NaN";
    case Type::TIME:
      return "T#-9223372036854775808ns to T#9223372036854775807ns, some 292 years";
    default:
      return decimal(lowest(type)) + " to " + decimal(highest(type));
  }
}

std::vector<Type> wider_types(Type type) {
  std::vector<Type> types;
  for (const TypeText& other : kTypes)
    if (other.type != type && widens(type, other.type)) types.push_back(other.type);
  return types;
}

std::vector<Type> conversions_of(Type type) {
  std::vector<Type> types;
  for (const TypeText& other : kTypes)
    if (other.type != type && convertible(type, other.type)) types.push_back(other.type);
  return types;
}

std::string names_of(std::span<const Type> types) {
  std::string text;
  for (const Type type : types) text += (text.empty() ? "" : ", ") + std::string(type_name(type));
  return text;
}

}  // namespace lockstep
