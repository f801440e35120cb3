"""One table of laws: closed forms, invariances, limits, hard cases, stored numbers, and who asks for them."""
