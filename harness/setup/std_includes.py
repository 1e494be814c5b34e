#!/usr/bin/env python3
"""Every source includes what it uses of the standard library, itself or by a header of ours.

Standard headers include each other as they like, and less of it from one release to the next, so that what is forgotten
compiles here and not there. Prints file:line of each name whose header is missing; exit code 1 if there is any.
    harness/setup/std_includes.py [FOLDER]      the repository, by default the one this file is in; a course's programs,
                                                which its own Makefiles build, are left out
"""
import functools
import pathlib
import re
import sys

# Names of std by the header that declares them: only those that our sources use, and no type that all headers have
# (size_t).
NAMES = {
    "algorithm": """adjacent_find all_of any_of binary_search clamp copy copy_if copy_n count count_if equal_range fill
        fill_n find find_if find_if_not for_each generate is_sorted lower_bound max max_element merge min min_element
        minmax minmax_element mismatch none_of nth_element partial_sort partition remove_if replace reverse rotate
        shuffle sort stable_partition stable_sort transform unique upper_bound ranges::all_of ranges::any_of
        ranges::count ranges::copy ranges::equal ranges::fill ranges::find ranges::find_if ranges::max
        ranges::max_element ranges::min ranges::min_element ranges::none_of ranges::partial_sort ranges::reverse
        ranges::rotate ranges::sort ranges::stable_sort ranges::transform ranges::unique""",
    "array": "array",
    "atomic": "atomic atomic_ref memory_order_relaxed",
    "bit": "bit_cast bit_ceil bit_floor bit_width countl_zero countr_zero endian has_single_bit popcount rotl",
    "cctype": "isalnum isalpha isdigit isspace isxdigit tolower toupper",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": """acos asin atan atan2 cbrt ceil copysign cos erf erfc exp exp2 expm1 floor fmax fmin fmod hypot ilogb
        isfinite isinf isnan ldexp lerp log log10 log1p log2 lround nan nanf nextafter pow remainder round signbit sin
        sqrt tan trunc""",
    "cstdint": """int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t uintmax_t uintptr_t""",
    "cstdio": "fclose feof ferror fflush fopen fprintf fputs fread fwrite printf snprintf",
    "cstdlib": "abort atoi calloc exit free getenv malloc strtod strtol strtoull",
    "cstring": "memcmp memcpy memset strchr strcmp strerror strlen",
    "ctime": "strftime time tm",
    "deque": "deque",
    "exception": "current_exception exception_ptr rethrow_exception",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream",
    "functional": "function less less_equal ranges::greater",
    "future": "async future launch",
    "iterator": "back_inserter istreambuf_iterator",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag scoped_lock unique_lock",
    "new": "align_val_t bad_alloc",
    "numbers": "numbers",
    "numeric": "accumulate iota",
    "optional": "nullopt optional",
    "random": """binomial_distribution chi_squared_distribution exponential_distribution gamma_distribution mt19937
        mt19937_64 normal_distribution uniform_int_distribution uniform_real_distribution""",
    "regex": "regex regex_match regex_replace regex_search smatch sregex_iterator",
    "set": "set",
    "span": "span",
    "sstream": "istringstream ostringstream stringstream",
    "stdexcept": "invalid_argument logic_error out_of_range runtime_error",
    "string": "string stod stoi stol stoul stoull to_string",
    "string_view": "string_view",
    "system_error": "errc error_code generic_category system_error",
    "thread": "jthread this_thread thread",
    "tuple": "make_tuple tie tuple",
    "type_traits": "conditional_t decay_t is_constructible_v is_integral_v is_same_v is_trivially_copyable_v remove_cvref_t",
    "unordered_map": "unordered_map",
    "utility": "declval exchange index_sequence make_index_sequence",
    "variant": "get_if holds_alternative variant variant_alternative_t variant_size_v visit",
    "vector": "vector",
}
HEADER = {name: header for header, names in NAMES.items() for name in names.split()}
# Names that several headers declare, and headers that include others according to the standard.
ALSO = {
    "abs": {"cmath", "cstdlib"},
    "function": {"functional"},
    "errc": {"system_error", "charconv"},
    "error_code": {"system_error", "filesystem"},
    "string": {"string", "fstream", "sstream", "filesystem", "regex"},
    "string_view": {"string_view", "string", "filesystem", "fstream", "sstream", "regex"},
    "byte": {"cstddef"},
}
HEADER["abs"] = "cmath"
USE = re.compile(r"\bstd::((?:ranges::)?[a-z_0-9]+)")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


class Sources:
    def __init__(self, root):
        self.root = root

    @functools.lru_cache(maxsize=None)
    def includes(self, path):
        """Standard headers that a file includes, and our own files."""
        standard, ours = set(), []
        for line in (self.root / path).read_text().splitlines():
            found = INCLUDE.match(line)
            if found and found.group(1) == "<":
                standard.add(found.group(2))
            elif found and (self.root / found.group(2)).is_file():
                ours.append(found.group(2))
        return standard, ours

    def files(self, path):
        """It and what it includes of ours, itself or by others."""
        seen, left = set(), [path]
        while left:
            one = left.pop()
            if one not in seen:
                seen.add(one)
                left += self.includes(one)[1]
        return seen

    def reachable(self, path):
        return set().union(*(self.includes(one)[0] for one in self.files(path)))

    def problems(self, path):
        has, told = self.reachable(path), set()
        code = NO_CODE.sub(lambda m: m.group(0) if m.group(0).startswith('"') and "#include" in m.group(0) else blank(m),
                           (self.root / path).read_text())
        for number, line in enumerate(code.splitlines(), 1):
            for name in USE.findall(line):
                header = HEADER.get(name)
                if header is None or header in told or has & ALSO.get(name, {header}):
                    continue
                told.add(header)
                yield f"{path}:{number}: std::{name} needs #include <{header}>"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent.parent).resolve()
    sources, count = Sources(root), 0
    folders = [f for f in ("renderer", "reference", "harness", "scenes", "reports") if (root / f).is_dir()]
    paths = sorted(p.relative_to(root).as_posix() for f in folders for end in ("*.h", "*.cpp")
                   for p in (root / f).rglob(end) if not {"missing_include", "courses"} & set(p.relative_to(root).parts))
    if not paths:
        print(f"{root}: no sources", file=sys.stderr)
        return 2
    for path in paths:
        for problem in sources.problems(path):
            print(problem)
            count += 1
    print(f"{len(paths)} files, {count} missing includes")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
