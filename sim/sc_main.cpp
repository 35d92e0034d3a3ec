// The SystemC library brings a main that calls sc_main. Our programs have mains of their own, but
// the library wants the symbol all the same.
#include <systemc>

int sc_main(int /*argc*/, char* /*argv*/[]) {
  return 0;
}
