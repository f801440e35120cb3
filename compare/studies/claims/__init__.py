"""The paper's claims on many contacts: crosscheck study."""
