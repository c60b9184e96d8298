# What current compilers refuse.

# The text begins with its line: a comment that quotes the old code is none.
mend(utils.h "\n    return static_cast< std::ostringstream & >(( std::ostringstream() << std::dec << a ) ).str();"
     "\n    std::ostringstream text; text << std::dec << a; return text.str();" "an ostringstream cast that does not compile")
mend(finish.cpp "\n      if (neighbor->lists[m]->numneigh > 0)" "\n      if (neighbor->lists[m]->inum > 0)" "a pointer compared with 0")
