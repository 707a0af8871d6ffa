"""Object models as data: templates (TOML) and learned weights (JSON)."""
