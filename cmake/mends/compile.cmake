# What current compilers refuse.

# The old text begins with a line end, so that a comment that quotes it does not match.
set(cast "static_cast< std::ostringstream & >(( std::ostringstream() << std::dec << a ) )")
mend(utils.h "\n    return ${cast}.str();"
     "\n    std::ostringstream text; text << std::dec << a; return text.str();"
     "an ostringstream cast does not compile")
mend(finish.cpp "\n      if (neighbor->lists[m]->numneigh > 0)" "\n      if (neighbor->lists[m]->inum > 0)"
     "a pointer is compared with 0")
