/// What the leak checker passes over: OSMesa keeps the buffers of a context that was destroyed. Read by the
/// sanitizers' runtime where there is one.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
