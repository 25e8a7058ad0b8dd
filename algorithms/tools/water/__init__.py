"""Water: finds lakes and rivers in classified points, with their levels."""
