(** * steep-ramp: Extinction that rises from nothing to 2 within a twentieth of the ray

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  2 * exp (120 * s) / (exp (120 * s) + exp 40).
Definition emission (s : R) : R :=
  1 + 1 / 60 * ln ((1 + exp (120 * s - 40)) / (1 + exp (-40))).
Definition exact_depth (lambda : R) : R :=
  1 / 60 * ln ((1 + exp (120 * lambda - 40)) / (1 + exp (-40))).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 1 / 60 * ln ((1 + exp (120 * lambda - 40)) / (1 + exp (-40)))) * exp (-1 / 60 * ln ((1 + exp (120 * lambda - 40)) / (1 + exp (-40)))).

Theorem steep_ramp (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
